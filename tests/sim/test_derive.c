/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Forces and compressions that follow from stored displacements are, to the bit, those that a run samples. */
#include "support.h"

#include "sim/chain/chain_data.h"

static void derived_forces_are_those_sampled(void **state)
{
    (void)state;
    static const char *const chains[] = {
        P3_CHAIN,
        P4_CHAIN,
        "chain: {wall: brass, tilt: 3.5 deg, precompression: 0.1 N, beads: [{bead: large-steel, count: 60}]}\n",
        "chain: {beads: [{bead: ptfe, count: 60}], law: {power: 2, coefficient: 1e9}}\n",
        "chain: {beads: [{bead: large-steel, count: 60}], wall: brass, law: thesis-appendix}\n",
        "chain: {beads: [{bead: large-steel, count: 60}], law: {fpu-alpha: 1000, stiffness: 1e7}}\n"};
    double contact[256], bead[256], compression[256], u[256];
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        struct built built = build(chains[c], "until: 0.3 ms");
        struct bead_run *run = start_run(&built, (struct bead_run_settings){.end = 0.3e-3});
        for (int i = 0; i < 100; i++) {
            double time = i * 0.003e-3;
            run_until(run, time);
            struct bead_sample s = sample_at(run, time);
            const size_t beads = bead_chain_beads(built.chain); /* nothing after the last one is read or written */
            memcpy(u, s.field[BEAD_FIELD_DISPLACEMENT], beads * sizeof *u);
            u[beads] = contact[beads] = bead[beads] = NAN;
            bead_derive_forces(built.chain, u, contact, bead);
            assert_true(isnan(contact[beads]) && isnan(bead[beads]));
            bead_derive_compressions(built.chain, s.field[BEAD_FIELD_DISPLACEMENT], 0, s.active - 1, compression);
            for (size_t j = 0; j < s.active; j++) {
                if (contact[j] != s.field[BEAD_FIELD_CONTACT_FORCE][j] || bead[j] != s.field[BEAD_FIELD_FORCE][j])
                    fail_msg("chain %zu, sample %d, bead %zu: not the same bits", c, i, j);
                if (j < bead_chain_contacts(built.chain) && compression[j] != s.field[BEAD_FIELD_COMPRESSION][j])
                    fail_msg("chain %zu, sample %d, contact %zu: not the same compression", c, i, j);
            }
        }
        bead_run_destroy(run);
        release(&built);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(derived_forces_are_those_sampled)};
    return cmocka_run_group_tests_name("derive", tests, NULL, NULL);
}
