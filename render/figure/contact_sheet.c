/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The life of a contact sheet, a sink of sweeps: chooses configurations, runs them until their fronts arrive, runs them again into
 * their pictures, and draws. */
#include "render/figure/contact_sheet.h"

#include <math.h>
#include <stdlib.h>

#include "render/view/orientation.h"
#include "sim/base/memory.h"
#include "sim/chain/chain_internal.h"

/* Samples per column of pixels along time; values are linear in time between samples. */
enum { SAMPLES_A_PIXEL = 4 };

void contact_sheet_clear(struct contact_sheet *s)
{
    for (size_t i = 0; s->images && i < s->image_count; i++) {
        bead_area_destroy(s->images[i].area);
        free(s->images[i].spin);
    }
    free(s->images);
    free(s->watches);
    free(s->rows);
}

/* Finds the beads of cells that are up or reversed, and the beginning of the part of the chain shown. */
static enum bead_error sheet_read_chain(struct contact_sheet *s, struct contact_image *image, struct bead_message *msg)
{
    BEAD_LEFT_TO(bead_sweep_chain_left) struct bead_sweep_chain *made = NULL;
    BEAD_TRY(bead_sweep_chain_create(s->sweep, image->panel, image->index, &made, msg));
    const struct bead_chain *chain = bead_sweep_chain_of(made);
    const struct bead_chain_spec *spec = bead_chain_spec(chain);
    const char *spin = bead_chain_spins(chain);
    size_t j = 1;
    image->magnetism = bead_chain_magnetism(chain);
    image->beads = bead_chain_beads(chain);
    BEAD_TRY(bead_new(&image->spin, image->beads, msg, "a sheet"));
    memset(image->spin, -1, image->beads);
    for (size_t g = 0; g < spec->segment_count; g++) {
        for (size_t c = 0; c < spec->segments[g].count; c++) {
            signed char of_cell = spec->segments[g].cell_beads > 1 ? (signed char)(*spin++ == '1') : -1;
            for (size_t b = 0; b < spec->segments[g].cell_beads; b++)
                image->spin[j++] = of_cell;
        }
    }
    image->rest = bead_colour_range_rest(&chain, 1, s->output->shown.field);
    const size_t values = s->of_contacts ? bead_chain_contacts(chain) : image->beads;
    const int columns = contact_columns(s, image), places = image->picture.width + image->picture.height - columns;
    const struct bead_area_setup setup = {{0, values - 1}, {0, s->end}, places, columns, BEAD_SAMPLING_AREA};
    return bead_area_create(&setup, &image->area, msg);
}

static enum bead_error take(void *context, const struct bead_sample *sample, struct bead_message *)
{
    const struct contact_image *image = context;
    bead_area_feed(image->area, sample->time, sample->field[image->field], sample->active);
    return BEAD_OK;
}

static enum bead_error take_pictures(struct contact_sheet *s, const struct bead_sweep_settings *settings, struct bead_message *msg)
{
    for (size_t i = 0; i < s->image_count; i++) {
        struct contact_image *image = &s->images[i];
        image->field = s->output->shown.field;
        BEAD_TRY(sheet_read_chain(s, image, msg));
        s->watches[i] = (struct bead_sweep_watch){.panel = image->panel,
                                                  .index = image->index,
                                                  .end = s->end,
                                                  .fields = BEAD_FIELD_BIT(image->field),
                                                  .every = s->end / (SAMPLES_A_PIXEL * (double)contact_columns(s, image)),
                                                  .take = take,
                                                  .context = image};
    }
    return bead_sweep_watch(s->sweep, s->watches, s->image_count, settings, msg);
}

/* Nothing is left out. */
static void find_colours(struct contact_sheet *s)
{
    struct bead_shown_values all = BEAD_NOTHING_SHOWN;
    all.rest = s->image_count > 0 ? s->images[0].rest : 0;
    for (size_t i = 0; i < s->image_count; i++)
        all.rest = s->images[i].rest == all.rest ? all.rest : 0;
    for (size_t i = 0; i < s->image_count; i++)
        bead_area_widen(s->images[i].area, &all);
    all.typical = INFINITY;
    all.usually_away = all.away;
    s->range = bead_colour_range_find(&s->output->colours, s->is_signed, &all);
    s->colours = bead_colour_range_colours(s->output, &s->range, s->range.rest > 0 ? &s->map_about_rest : &s->map);
}

/* Finds page, look and colour map. */
static enum bead_error sheet_prepare(struct contact_sheet *s, struct bead_message *msg)
{
    static const double smaller = 0.85;
    BEAD_LEFT_TO(bead_sweep_chain_left) struct bead_sweep_chain *made = NULL;
    BEAD_TRY(bead_page_find(s->output, &s->page, msg));
    BEAD_TRY(bead_colour_range_check(s->output, msg));
    BEAD_TRY(bead_sweep_chain_create(s->sweep, 0, BEAD_SWEEP_CLEAN, &made, msg));
    bead_page_look(&s->page, &s->output->paper, &s->look);
    s->small = smaller * s->look.tick;
    s->orientation = bead_orientation_of(s->output);
    s->of_contacts = bead_field_info(s->output->shown.field)->of_contacts;
    s->behind = bead_sweep_panel(s->sweep, 0)->spec->measures.sensor_count == 0;
    s->is_signed = bead_chain_signed(bead_sweep_chain_of(made), s->output->shown.field);
    BEAD_TRY(bead_colour_range_map(s->output, bead_sweep_chain_of(made), s->look.dark, false, &s->map, msg));
    return bead_colour_range_map(s->output, bead_sweep_chain_of(made), s->look.dark, true, &s->map_about_rest, msg);
}

enum bead_error contact_sheet_make(struct contact_sheet *s, const struct bead_sweep_settings *settings, struct bead_message *msg)
{
    BEAD_TRY(sheet_prepare(s, msg));
    BEAD_TRY(contact_sheet_arrange(s, msg));
    for (size_t i = 0; i < s->image_count; i++)
        s->watches[i] = (struct bead_sweep_watch){.panel = s->images[i].panel, .index = s->images[i].index};
    BEAD_TRY(bead_sweep_end(s->sweep, s->watches, s->image_count, settings, &s->end, msg));
    BEAD_TRY(take_pictures(s, settings, msg));
    find_colours(s);
    return BEAD_OK;
}

static enum bead_error write_sheet(const struct bead_output *output, const struct bead_run_context *context, const char *path,
                                   uint64_t *bytes, struct bead_message *msg)
{
    BEAD_LEFT_TO(contact_sheet_clear) struct contact_sheet s = {.output = output, .sweep = context->sweep};
    BEAD_TRY(contact_sheet_make(&s, context->sweep_settings, msg));
    const struct bead_drawing drawing = {contact_sheet_draw, NULL, &s, NULL};
    return bead_page_write(&s.page, output, context->scene, &drawing, path, bytes, msg);
}

/* Do the pictures fit the page? */
static enum bead_error check_sheet(const struct bead_output *output, const struct bead_run_context *context,
                                   struct bead_message *msg)
{
    BEAD_LEFT_TO(contact_sheet_clear) struct contact_sheet s = {.output = output, .sweep = context->sweep};
    BEAD_TRY(sheet_prepare(&s, msg));
    return contact_sheet_arrange(&s, msg);
}

static const char *sheet_why(const struct bead_output *)
{
    return "small pictures of many configurations, rows by magnetism; only these run";
}

const struct bead_sink_type bead_contact_sheet_sink = {.name = "sheet",
                                                       .help = "small pictures of many configurations of a sweep",
                                                       .kind = BEAD_OUTPUT_SHEET,
                                                       .check = check_sheet,
                                                       .why = sheet_why,
                                                       .write = write_sheet,
                                                       .runs_chains = true,
                                                       .without_results = true};
