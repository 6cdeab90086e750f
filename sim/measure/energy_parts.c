/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the parts of a chain's energy: see energy_parts.h. */
#include "sim/measure/energy_parts.h"

#include <math.h>

/* A pulse ends where the force falls to this part of its maximum; a force below this part of its earlier value belongs to another
 * pulse. */
static const double valley = 0.1;

enum { FORMS = 6, PLACES = 4, BESIDE = 2 };
static const char *const forms[FORMS] = {"kinetic", "contacts", "wall", "gravity", "springs", "dissipated"},
                         *const places[PLACES] = {"front", "behind", "reflected", "dissipated"},
                         *const beside[BESIDE] = {"work", "total"};

static bool by_place(const struct bead_output *output)
{
    return output->curves.parts == BEAD_PARTS_BY_PLACE;
}

size_t bead_energy_parts_stacked(const struct bead_output *output)
{
    return by_place(output) ? PLACES : FORMS;
}

size_t bead_energy_parts_count(const struct bead_output *output)
{
    return bead_energy_parts_stacked(output) + BESIDE + output->curves.beads.count;
}

void bead_energy_part_name(const struct bead_output *output, size_t i, char name[40])
{
    const size_t stacked = bead_energy_parts_stacked(output);
    if (i < stacked + BESIDE)
        snprintf(name, 40, "%s", i >= stacked ? beside[i - stacked] : by_place(output) ? places[i] : forms[i]);
    else
        snprintf(name, 40, "past bead %zu", output->curves.beads.all[i - stacked - BESIDE]);
}

/* Follows the first pulse: from the end of the chain, the first force that is a good part of the pulse's peak at the last sample,
 * then the first contact behind it whose force is small. */
static void follow(const struct bead_budget *b, size_t contacts, size_t beads, struct bead_energy_front *front)
{
    double largest = 0, best = 0;
    size_t at = contacts;
    if (front->from == SIZE_MAX)
        return;
    for (size_t k = front->from; k < contacts; k++)
        largest = fmax(largest, b->force[k]);
    if (!(largest > 0 || front->peak > 0)) /* nothing has been struck so far */
        return;
    const double least = valley * (front->peak > 0 && front->peak * valley < largest ? front->peak : largest);
    for (size_t k = contacts; k-- > front->from;) {
        if (b->force[k] > best && b->force[k] > least) {
            best = b->force[k];
            at = k;
        } else if (best > 0 && b->force[k] <= valley * best) {
            front->from = k + 1;
            break;
        }
    }
    front->peak = best;
    if (at < contacts && b->force[at] * b->velocity[at] < 0 && (at + 1 >= beads || b->velocity[at + 1] < 0))
        front->from = SIZE_MAX;
    else if (at == contacts) /* it has left the contacts for the last bead */
        front->from = beads - 1;
}

static void find_places(const struct bead_budget *b, const struct bead_chain *chain, struct bead_energy_front *front, double *parts)
{
    const size_t beads = bead_chain_beads(chain), contacts = bead_chain_contacts(chain);
    follow(b, contacts, beads, front);
    parts[0] = parts[1] = parts[2] = 0;
    for (size_t j = 0; j < beads; j++) {
        const double force = (j > 0 ? b->force[j - 1] : 0) + (j < contacts ? b->force[j] : 0);
        const bool back = force != 0 ? force * b->velocity[j] < 0 : b->velocity[j] < 0;
        parts[back ? 2 : j >= front->from ? 0 : 1] += b->energy[j];
    }
}

void bead_energy_parts_find(const struct bead_output *output, const struct bead_chain *chain, const struct bead_sample *sample,
                            struct bead_energy_front *front, double *parts)
{
    const struct bead_budget *b = sample->budget;
    const double form[FORMS] = {b->kinetic, b->contacts, b->wall, b->gravity, b->springs, b->dissipated};
    const size_t stacked = bead_energy_parts_stacked(output), beads = bead_chain_beads(chain);
    double total = -b->work;
    if (by_place(output))
        find_places(b, chain, front, parts);
    for (size_t i = 0; i < stacked; i++) {
        parts[i] = by_place(output) && i + 1 < stacked ? parts[i] : form[i + FORMS - stacked];
        total += parts[i];
    }
    parts[stacked] = b->work;
    parts[stacked + 1] = total;
    for (size_t i = 0; i < output->curves.beads.count; i++) {
        double past = 0;
        for (size_t j = output->curves.beads.all[i] + 1; j < beads; j++)
            past += b->energy[j];
        parts[stacked + BESIDE + i] = past;
    }
}
