/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/pictures.h"

#include <dirent.h>
#include <math.h>
#include <png.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "beadreel/render.h"

enum { BEADS = 10 };

static char directory[256];

int make_directory(void **state)
{
    (void)state;
    const char *tmp = getenv("TMPDIR");
    snprintf(directory, sizeof directory, "%s/pictures.XXXXXX", tmp ? tmp : "/tmp");
    return mkdtemp(directory) ? 0 : -1;
}

void in_directory(const char *name, char *path, size_t size)
{
    snprintf(path, size, "%s/%s", directory, name);
}

static void for_all_files(void (*what)(const char *path))
{
    DIR *dir = opendir(directory);
    for (struct dirent *entry = dir ? readdir(dir) : NULL; entry; entry = readdir(dir)) {
        char path[600];
        if (entry->d_name[0] == '.')
            continue;
        snprintf(path, sizeof path, "%s/%s", directory, entry->d_name);
        what(path);
    }
    if (dir)
        closedir(dir);
}

static void remove_file(const char *path)
{
    unlink(path);
}

static void no_part(const char *path)
{
    assert_null(strstr(path, ".part"));
}

int remove_directory(void **state)
{
    (void)state;
    for_all_files(remove_file);
    return rmdir(directory);
}

void assert_no_part_files(void)
{
    for_all_files(no_part);
}

char *read_all(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    *length = (size_t)ftell(file);
    rewind(file);
    char *text = malloc(*length + 1);
    assert_int_equal(fread(text, 1, *length, file), *length);
    fclose(file);
    text[*length] = '\0';
    return text;
}

struct built build_chain(const char *output)
{
    char text[1024];
    struct bead_message msg = {""};
    struct built built = {NULL, NULL};
    snprintf(text, sizeof text,
             "title: A test\nchain: {name: Ten, beads: [{bead: large-steel, count: 9}], wall: brass}\n"
             "simulate: {until: 1 ms}\noutputs: [{%s}]\n",
             *output ? output : "table: t.csv, show: peaks");
    if (bead_scene_parse("test", text, strlen(text), NULL, &built.scene, &msg) ||
        bead_chain_create(built.scene, 0, &built.chain, &msg))
        fail_msg("%s", msg.text);
    assert_int_equal(bead_chain_beads(built.chain), BEADS);
    return built;
}

void release_chain(struct built *built)
{
    bead_chain_destroy(built->chain);
    bead_scene_free(built->scene);
}

struct bead_run_context make_stage(const struct built *built)
{
    return (struct bead_run_context){.scene = built->scene,
                                     .chains = (const struct bead_chain *const *)&built->chain,
                                     .chain_count = 1,
                                     .end = 1e-3,
                                     .resolution = 1e-6,
                                     .threads = 1,
                                     .directory = directory};
}

static struct bead_sample *new_sample(const struct built *built, double time, made_up values)
{
    struct bead_sample *sample = calloc(1, sizeof *sample);
    size_t beads = bead_chain_beads(built->chain), contacts = bead_chain_contacts(built->chain);
    sample->time = time;
    sample->active = beads;
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++) {
        double *array = calloc(beads + 1, sizeof *array);
        for (size_t i = 0; i < (bead_field_info((enum bead_field)f)->of_contacts ? contacts : beads); i++)
            array[i] = values(i, time) * (f == BEAD_FIELD_DISPLACEMENT ? 1e-7 : 1);
        sample->field[f] = array;
    }
    return sample;
}

static double wave(size_t bead, double time)
{
    return 15 + 15 * sin((double)bead - 2e4 * time);
}

struct bead_sample *make_sample(const struct built *built, double time)
{
    return new_sample(built, time, wave);
}

void free_sample(struct bead_sample *sample)
{
    for (size_t f = 0; f < BEAD_FIELD_COUNT; f++)
        free((double *)sample->field[f]);
    free(sample);
}

double pulse_down_the_chain(size_t bead, double time)
{
    double since = time - 1e-4 * (double)bead, left = 1e-4 - since, ramp = 5e-6;
    return since <= 0 || left <= 0 ? 0 : 10 * fmin(1, fmin(since, left) / ramp);
}

static const struct bead_sink_type *sink_of(const struct bead_output *output)
{
    for (const struct bead_sink_type *const *type = bead_render_sinks(); *type; type++) {
        if ((*type)->kind == output->kind && (*type)->create && !(*type)->one_frame)
            return *type;
    }
    return NULL;
}

void draw_output(const struct built *built, made_up values)
{
    const struct bead_output *output = &built->scene->outputs[0];
    const struct bead_sink_type *type = sink_of(output);
    struct bead_run_context context = make_stage(built);
    struct bead_message msg = {""};
    struct bead_sink *sink = NULL;
    struct bead_needs needs;
    enum bead_error err = type->create(output, &context, &sink, &msg);
    if (err)
        fail_msg("%s", msg.text);
    type->needs(sink, &needs);
    err = type->begin(sink, (struct bead_range){0, 10}, &msg);
    for (size_t i = 0; !err && i < bead_grid_count(&needs.grid); i++) {
        struct bead_sample *sample = new_sample(built, bead_grid_time(&needs.grid, i), values);
        sample->index = i;
        err = type->sample(sink, sample, &msg);
        free_sample(sample);
    }
    if (!err)
        err = type->end(sink, NULL, &msg);
    type->destroy(sink);
    if (err)
        fail_msg("%s", msg.text);
    assert_no_part_files();
}

static void read_notes(png_structp png, png_infop info, struct png_file *file)
{
    png_textp text;
    int count = 0, unit = 0, intent;
    png_uint_32 x = 0, y = 0;
    png_get_text(png, info, &text, &count);
    for (int i = 0; i < count; i++) {
        if (strcmp(text[i].key, "Title") == 0)
            snprintf(file->title, sizeof file->title, "%s", text[i].text);
        if (strcmp(text[i].key, "Source") == 0)
            snprintf(file->source, sizeof file->source, "%s", text[i].text);
    }
    png_get_pHYs(png, info, &x, &y, &unit);
    file->per_metre = x == y && unit == PNG_RESOLUTION_METER ? x : 0;
    file->srgb = png_get_sRGB(png, info, &intent) != 0;
}

struct png_file read_png(const char *path)
{
    struct png_file file = {0};
    FILE *in = fopen(path, "rb");
    if (!in)
        fail_msg("cannot read %s", path);
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    if (setjmp(png_jmpbuf(png)))
        fail_msg("%s is not a good PNG", path);
    png_init_io(png, in);
    png_read_info(png, info);
    file.width = (int)png_get_image_width(png, info);
    file.height = (int)png_get_image_height(png, info);
    file.colour_type = png_get_color_type(png, info);
    read_notes(png, info, &file);
    png_set_expand(png);
    png_read_update_info(png, info);
    size_t row = png_get_rowbytes(png, info);
    assert_int_equal(row, 3 * (size_t)file.width);
    file.rgb = malloc(row * (size_t)file.height);
    for (int y = 0; y < file.height; y++)
        png_read_row(png, file.rgb + (size_t)y * row, NULL);
    png_read_end(png, NULL);
    png_destroy_read_struct(&png, &info, NULL);
    fclose(in);
    return file;
}

void assert_border_white(const struct png_file *png, const char *what)
{
    for (int i = 0; i < png->width * png->height; i++) {
        int x = i % png->width, y = i / png->width;
        bool border = x == 0 || y == 0 || x == png->width - 1 || y == png->height - 1;
        if (border && (png->rgb[3 * i] != 255 || png->rgb[3 * i + 1] != 255 || png->rgb[3 * i + 2] != 255))
            fail_msg("%s: pixel %d, %d of the border is drawn on", what, x, y);
    }
}
