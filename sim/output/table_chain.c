/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of chains at rest: a row for each bead, with the contact to its right. They need no run. */
#include "sim/output/table.h"

static void write_sensor(FILE *file, const struct bead_chain *chain, size_t bead)
{
    size_t count = 0;
    const struct bead_sensor *sensors = bead_chain_sensors(chain, &count);
    for (size_t i = 0; i < count; i++) {
        if (sensors[i].bead == bead)
            bead_table_text(file, sensors[i].name);
    }
}

static void write_bead(struct bead_sink *sink, size_t index, size_t bead)
{
    const struct bead_chain *chain = sink->context.chains[index];
    bead_table_chain_name(sink, index);
    fprintf(sink->file, "%zu,", bead);
    bead_table_text(sink->file, bead_chain_scene(chain)->materials[bead_chain_material(chain)[bead]].name);
    bead_table_numbers(
        sink->file, 3,
        (const double[]){bead_chain_mass(chain)[bead], bead_chain_radius(chain)[bead], bead_chain_position(chain)[bead]});
    fputc(',', sink->file);
    write_sensor(sink->file, chain, bead);
    if (bead < bead_chain_contacts(chain))
        bead_table_numbers(sink->file, 2,
                           (const double[]){bead_chain_stiffness(chain)[bead], bead_chain_static_force(chain)[bead]});
    else
        fputs(",,", sink->file);
    bead_table_end_row(sink);
}

static void chain_end(struct bead_sink *sink, const struct bead_outcome *)
{
    for (size_t c = 0; c < sink->context.chain_count; c++) {
        for (size_t i = 0; i < bead_chain_beads(sink->context.chains[c]); i++)
            write_bead(sink, c, i);
    }
}

const struct table bead_table_chain = {.why = "beads and contacts as in the scene",
                                       .columns = "bead,material,mass_kg,radius_m,position_m,sensor,stiffness,static_force_N",
                                       .end = chain_end};
