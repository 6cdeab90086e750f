/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of the derivatives of peak forces: a row for each bead and each contact asked for. */
#include <math.h>

#include "sim/base/number.h"
#include "sim/output/table.h"

static void sensitivities_needs(const struct bead_sink *sink, struct bead_needs *needs)
{
    needs->contact_peaks = needs->sensitivities = true;
    needs->contacts = sink->output->curves.contacts.all;
    needs->contact_count = sink->output->curves.contacts.count;
}

/* From those of the check run: that of the worst bead, since errors cross zero along a chain. NaN: unknown. */
static void find_uncertainties(const struct bead_sink *sink, size_t chain, const struct bead_sensitivity *s,
                               const struct bead_sensitivity *check, double uncertainty[4])
{
    const size_t beads = bead_chain_beads(sink->context.chains[chain]);
    for (size_t i = 0; i < 4; i++)
        uncertainty[i] = NAN;
    if (!check)
        return;
    uncertainty[0] = bead_table_worst(sink, s->mass, check->mass, beads);
    uncertainty[1] = bead_table_worst(sink, s->radius, check->radius, beads);
    uncertainty[2] = bead_table_worst(sink, s->modulus, check->modulus, beads);
    uncertainty[3] = bead_table_worst(sink, &s->velocity, &check->velocity, 1);
}

/* The derivative with respect to the striker's velocity is in the row of bead 0. */
static void write_contact(struct bead_sink *sink, size_t chain, const struct bead_peak *peak, const struct bead_sensitivity *s,
                          const struct bead_sensitivity *check)
{
    double uncertainty[4];
    find_uncertainties(sink, chain, s, check, uncertainty);
    char force[BEAD_NUMBER_ROOM], time[BEAD_NUMBER_ROOM]; /* the same in all rows: converting numbers is slow */
    bead_number_text(force, peak->value);
    bead_number_text(time, peak->time);
    for (size_t j = 0; j < bead_chain_beads(sink->context.chains[chain]); j++) {
        bead_table_chain_name(sink, chain);
        fprintf(sink->file, "%zu,%s,%s,%zu", s->index, force, time, j);
        bead_table_numbers(sink->file, 3, (const double[]){s->mass[j], s->radius[j], s->modulus[j]});
        if (j == 0)
            bead_table_numbers(sink->file, 1, &s->velocity);
        else
            fputc(',', sink->file);
        if (bead_table_is_judged(sink))
            bead_table_uncertainties(sink->file, 3, uncertainty);
        if (bead_table_is_judged(sink) && j == 0)
            bead_table_uncertainties(sink->file, 1, &uncertainty[3]);
        else if (bead_table_is_judged(sink))
            fputc(',', sink->file);
        bead_table_end_row(sink);
    }
}

static bool is_asked(const struct bead_sink *sink, const struct bead_sensitivity *s)
{
    const struct bead_curves_asked *curves = &sink->output->curves;
    bool asked = !curves->contacts.all && s->of_default;
    for (size_t i = 0; i < curves->contacts.count; i++)
        asked = asked || curves->contacts.all[i] == s->index;
    return asked;
}

static void sensitivities_end(struct bead_sink *sink, const struct bead_outcome *outcomes)
{
    for (size_t c = 0; outcomes && c < sink->context.chain_count; c++) {
        const struct bead_sensitivity *check = outcomes[c].check ? outcomes[c].check->sensitivities : NULL;
        for (size_t i = 0; i < outcomes[c].sensitivity_count; i++) {
            const struct bead_sensitivity *s = &outcomes[c].sensitivities[i];
            if (is_asked(sink, s))
                write_contact(sink, c, &outcomes[c].contact_peaks[s->index], s, check ? &check[i] : NULL);
        }
    }
}

const struct table bead_table_sensitivities = {.why = "derivatives of peaks by masses, radii, moduli and the striker's velocity",
                                               .needs = sensitivities_needs,
                                               .columns = "contact,peak_force_N,time_s,bead,by_mass_N_per_kg,by_radius_N_per_m,"
                                                          "by_modulus_N_per_Pa,by_striker_velocity_N_s_per_m",
                                               .uncertainties = ",by_mass_N_per_kg_uncertainty,by_radius_N_per_m_uncertainty,"
                                                                "by_modulus_N_per_Pa_uncertainty,"
                                                                "by_striker_velocity_N_s_per_m_uncertainty",
                                               .checked = true,
                                               .end = sensitivities_end};
