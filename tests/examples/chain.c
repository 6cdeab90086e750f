/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strike 20 equal steel beads, watch the largest force along the chain, print the peaks. No scene, no file.
 * Build: cc chain.c $(pkg-config --cflags --libs beadsim) */
#include <beadreel/chain.h>
#include <beadreel/play.h>
#include <stdio.h>

static enum bead_error watch(void *context, const struct bead_sample *sample, struct bead_message *msg)
{
    double *largest = context;
    (void)msg;
    for (size_t k = 0; k < 20; k++)
        *largest = sample->field[BEAD_FIELD_CONTACT_FORCE][k] > *largest ? sample->field[BEAD_FIELD_CONTACT_FORCE][k] : *largest;
    return BEAD_OK;
}

int main(void)
{
    const struct bead_properties steel = {.radius = 4.76e-3, .mass = 3.63e-3, .modulus = 193e9, .poisson = 0.30};
    struct bead_chain_settings made = {.size = sizeof made, .beads = &steel, .count = 1, .repeat = 20, .velocity = 0.4};
    struct bead_player_settings played = {.size = sizeof played,
                                          .contact_peaks = true,
                                          .take = watch,
                                          .fields = BEAD_FIELD_BIT(BEAD_FIELD_CONTACT_FORCE),
                                          .every = 1e-6};
    const struct bead_outcome *outcome;
    struct bead_player *player = NULL;
    struct bead_chain *chain;
    struct bead_message msg;
    double largest = 0;

    enum bead_error err = bead_chain_make(&made, &chain, &msg);
    played.chain = chain;
    played.context = &largest;
    if (!err)
        err = bead_player_create(&played, &player, &msg);
    if (!err)
        err = bead_player_until(player, 1.0, &msg); /* s; the run is over before, when the pulse has passed */
    if (!err)
        err = bead_player_finish(player, &outcome, &msg);
    for (size_t k = 0; !err && k < bead_chain_contacts(chain); k++)
        printf("contact %2zu: %.4f N at %.4f us\n", k, outcome->contact_peaks[k].value, 1e6 * outcome->contact_peaks[k].time);
    if (err)
        fprintf(stderr, "%s\n", msg.text);
    else
        printf("largest of the samples: %.4f N\n", largest);
    bead_player_destroy(player);
    bead_chain_destroy(chain);
    return bead_error_status(err);
}
