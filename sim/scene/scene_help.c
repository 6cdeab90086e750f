/* All keys of scenes, from the tables that read them. */
#include "sim/scene/scene_private.h"

static const struct bead_options *const all[] = {
    &bead_scene_options,        &bead_chain_options,      &bead_striker_options,        &bead_segment_options,
    &bead_law_options,          &bead_damping_options,    &bead_material_options,       &bead_simulate_options,
    &bead_output_options,       &bead_equation_options,   &bead_start_mode_options,     &bead_start_pulse_options,
    &bead_start_cosine_options, &bead_start_wave_options, &bead_start_solitons_options, &bead_soliton_options,
    &bead_caption_options,      &bead_card_options,       &bead_sweep_options,          &bead_sweep_measure_options,
};

void bead_scene_help(FILE *out)
{
    fputs("A scene is a YAML file. A number is in SI units or carries its unit, such as 0.443 m/s, 1.5 ms or 193 GPa.\n", out);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        fputc('\n', out);
        bead_options_help(all[i], out);
    }
}

void bead_scene_help_man(FILE *out)
{
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        bead_options_man(all[i], out);
}
