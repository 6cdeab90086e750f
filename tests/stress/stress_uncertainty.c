/* SPDX-License-Identifier: GPL-3.0-or-later */
/* No peak of random chains has an error above both the requested accuracy and its uncertainty; and uncertainties are not needlessly
 * large. */
#include "tests/stress/stress.h"

#include "tests/drawn.h"

static const double asked[] = {1e-4, 1e-6, 1e-8};
enum { ASKED = sizeof asked / sizeof *asked, CHAINS = 36, FIRST = 1 };

static void row(struct stress *stress, uint64_t seed)
{
    struct drawn drawn = drawn_make(seed, 150);
    char name[64], text[256] = "";
    bool ok = true;
    for (size_t i = 0, used = 0; i < ASKED; i++) {
        const struct kept kept = drawn_ask(&drawn, asked[i]);
        ok = ok && kept.of_uncertainty <= 1 && (kept.hidden <= 10 || kept.ill > chaotic);
        used += (size_t)snprintf(text + used, sizeof text - used, "  %5.0e: %7.2g %7.2g %7.2g %7.2g", asked[i], kept.error,
                                 kept.of_uncertainty, kept.hidden, kept.ill);
    }
    snprintf(name, sizeof name, "chain %2d, %3zu beads", (int)seed, drawn.fine.count - drawn.fine.contacts);
    stress_row(stress, ok, name, "%s", text);
    drawn_end(&drawn);
}

int main(int count, char **word)
{
    struct stress stress = stress_start();
    const int first = count > 1 ? atoi(word[1]) : FIRST, last = count > 2 ? atoi(word[2]) : first + (stress.quick ? 6 : CHAINS);
    printf("For accuracies asked: the largest error in units of that; in units of the larger of that and the uncertainty; the "
           "largest\n"
           "uncertainty of a well-conditioned peak in units of the larger of asked and error; the largest answer of a peak to a "
           "change of\n"
           "the stiffnesses:\n");
    for (int seed = first; seed < last; seed++)
        row(&stress, (uint64_t)seed);
    return stress_end(&stress);
}
