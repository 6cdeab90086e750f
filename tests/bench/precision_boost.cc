/* SPDX-License-Identifier: GPL-3.0-or-later */
// Solve a problem of precision_stream with Boost.odeint: precision_boost FILE rkn_sb3a STEP | rkf78 TOLERANCE > stream.
//
// Only the solver's own steps are timed, not writing them.
#include <boost/numeric/odeint.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace odeint = boost::numeric::odeint;
using state = std::vector<double>;

static double cpu_seconds()
{
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

struct chain {
    std::size_t beads;
    double speed, early, end, scale;
    state inverse_mass, stiffness, d0, f0;
    mutable state force;
    mutable double evaluations;

    explicit chain(const char *path) : evaluations(0)
    {
        std::ifstream file(path);
        double n, zero, m, a, d, f;
        file >> n >> speed >> early >> end >> scale >> zero >> zero >> zero;
        beads = std::size_t(n);
        while (file >> m >> a >> d >> f) {
            inverse_mass.push_back(1 / m);
            stiffness.push_back(a);
            d0.push_back(d);
            f0.push_back(f);
        }
        force.assign(beads + 1, 0);
    }

    void accelerations(const double *u, double *a) const
    {
        double *f = force.data() + 1;
        for (std::size_t k = 0; k + 1 < beads; k++) {
            double d = std::fmax(d0[k] + (u[k] - u[k + 1]), 0);
            f[k] = stiffness[k] * (d * std::sqrt(d)) - f0[k];
        }
        double last = std::fmax(d0[beads - 1] + u[beads - 1], 0);
        f[beads - 1] = stiffness[beads - 1] * (last * std::sqrt(last)) - f0[beads - 1];
        for (std::size_t j = 0; j < beads; j++)
            a[j] = (force[j] - force[j + 1]) * inverse_mass[j];
        evaluations++;
    }
};

static void write(double t, const double *u, const double *v, std::size_t n)
{
    std::fwrite(&t, sizeof t, 1, stdout);
    std::fwrite(u, sizeof *u, n, stdout);
    std::fwrite(v, sizeof *v, n, stdout);
}

// McLachlan's symplectic Runge-Kutta-Nystrom SB3A of order 4, equal steps.
static double symplectic(const chain &c, double step)
{
    odeint::symplectic_rkn_sb3a_mclachlan<state> stepper;
    state u(c.beads, 0.0), v(c.beads, 0.0);
    v[0] = c.speed;
    auto rates = [&c](const state &q, state &a) { c.accelerations(q.data(), a.data()); };
    const double ends[] = {c.early, c.end};
    double t = 0, cpu = 0;
    for (double stop : ends) {
        const double from = t, count = std::ceil((stop - from) / step * (1 - 1e-9)), h = (stop - from) / count;
        for (double i = 1; i <= count; i++) {
            double clock = cpu_seconds();
            stepper.do_step(rates, std::make_pair(std::ref(u), std::ref(v)), t, h);
            cpu += cpu_seconds() - clock;
            t = i < count ? from + i * h : stop;
            write(t, u.data(), v.data(), c.beads);
        }
    }
    return cpu;
}

// Fehlberg's 7(8) with odeint's step control; displacements in units of `scale`, velocities in the striker's.
static double controlled(const chain &c, double tolerance)
{
    const std::size_t n = c.beads;
    state y(2 * n, 0.0), u(n), v(n);
    y[n] = 1;
    auto rates = [&](const state &x, state &rate, double) {
        for (std::size_t j = 0; j < n; j++) {
            u[j] = x[j] * c.scale;
            rate[j] = x[n + j] * c.speed / c.scale;
        }
        c.accelerations(u.data(), rate.data() + n);
        for (std::size_t j = 0; j < n; j++)
            rate[n + j] /= c.speed;
    };
    auto stepper = odeint::make_controlled(tolerance, 0.0, odeint::runge_kutta_fehlberg78<state>());
    const double ends[] = {c.early, c.end};
    double t = 0, h = 1e-7, cpu = 0;
    for (double stop : ends) {
        while (t < stop) {
            double left = stop - t, kept = h;
            h = h < left ? h : left;
            bool last = h == left;
            double clock = cpu_seconds();
            bool done = stepper.try_step(rates, y, t, h) == odeint::success;
            cpu += cpu_seconds() - clock;
            if (!done)
                continue;
            if (last) {
                t = stop;
                h = kept;
            }
            for (std::size_t j = 0; j < n; j++) {
                u[j] = y[j] * c.scale;
                v[j] = y[n + j] * c.speed;
            }
            write(t, u.data(), v.data(), n);
        }
    }
    return cpu;
}

int main(int count, char **word)
{
    if (count != 4)
        return 2;
    chain c(word[1]);
    double value = std::atof(word[3]);
    double cpu = std::string(word[2]) == "rkf78" ? controlled(c, value) : symplectic(c, value);
    std::vector<double> last(2 * c.beads + 1, 0.0);
    last[0] = -1;
    last[1] = cpu;
    last[2] = c.evaluations;
    std::fwrite(last.data(), sizeof(double), last.size(), stdout);
    return 0;
}
