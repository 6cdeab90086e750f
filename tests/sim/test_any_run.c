/* SPDX-License-Identifier: GPL-3.0-or-later */
/* For any scene: each table is, byte for byte, what it is alone, in another order, with other threads, instructions and windows,
 * and made later from a trajectory, whole or of the part that it needs. */
#include "support.h"

#include <sys/stat.h>

#include "sessions.h"
#include "tests/any_scene.h"
#include "tests/scratch.h"

enum { SCENES = 34, POSSIBLE = 250 /* of their outputs: the others are not for their chains */, BYTES_MOST = 1 << 18 };

static char scene_path[600];

/* The scene with these of its outputs, as 0.csv, 1.csv and so on, and `last`. */
static void write_any(const struct any_scene *scene, const bool *with, bool reversed, const char *last)
{
    char text[12000];
    size_t used = (size_t)snprintf(text, sizeof text, "%soutputs:\n", scene->chain.text);
    for (size_t i = 0; i < ANY_OUTPUTS; i++) {
        const size_t o = reversed ? ANY_OUTPUTS - 1 - i : i;
        if (with[o])
            used += (size_t)snprintf(text + used, sizeof text - used, "  - {table: %zu.csv, %s}\n", o, scene->output[o]);
    }
    snprintf(text + used, sizeof text - used, "%s", last);
    snprintf(scene_path, sizeof scene_path, "%s/scene.yaml", directory);
    write_text(scene_path, text);
}

static const char *in(const char *folder, const char *name)
{
    static char path[4][600];
    static size_t turn;
    turn = (turn + 1) % 4;
    snprintf(path[turn], sizeof path[turn], "%s/%s", directory, folder);
    mkdir(path[turn], 0777);
    snprintf(path[turn], sizeof path[turn], "%s/%s/%s", directory, folder, name);
    return path[turn];
}

static enum bead_error try_job(struct bead_job job, struct bead_message *msg)
{
    static const struct bead_sink_type *const *sinks[2];
    struct bead_session *session = NULL;
    sinks[0] = bead_data_sinks();
    job.sinks = sinks;
    job.size = sizeof job;
    enum bead_error err = bead_session_open(&job, &session, msg);
    if (!err)
        err = bead_session_run(session, msg);
    bead_session_close(session);
    return err;
}

/* Which outputs the chains can have. */
static size_t find_possible(const struct any_scene *scene, bool with[ANY_OUTPUTS])
{
    size_t count = 0;
    for (size_t o = 0; o < ANY_OUTPUTS; o++) {
        struct bead_message msg = {""};
        bool one[ANY_OUTPUTS] = {false};
        one[o] = true;
        write_any(scene, one, false, "");
        const enum bead_error err = try_job((struct bead_job){.input = scene_path, .output = in("alone", ""), .threads = 1}, &msg);
        if (err && err != BEAD_ERROR_SCENE)
            fail_msg("%s\n%s: '%s'", scene->chain.text, scene->output[o], msg.text);
        with[o] = !err;
        count += !err;
    }
    return count;
}

static char bytes[2][BYTES_MOST];

static void read_file(const char *path, char *to)
{
    FILE *file = fopen(path, "r");
    if (!file)
        fail_msg("no %s", path);
    const size_t count = fread(to, 1, BYTES_MOST, file);
    fclose(file);
    if (count < 20 || count >= BYTES_MOST)
        fail_msg("%zu bytes in %s", count, path);
    to[count] = '\0';
}

/* Measures of the last sample have its time as their note, those of the end of a run have none. */
static void drop_notes(char *text)
{
    for (char *at = text; (at = strstr(at, ",at ")); at++)
        memmove(at + 1, at + 1 + strcspn(at + 1, ",\n"), strlen(at + 1 + strcspn(at + 1, ",\n")) + 1);
}

static void drop_row(char *text, const char *name)
{
    for (char *at = text; (at = strstr(at, name));) {
        while (at > text && at[-1] != '\n')
            at--;
        memmove(at, strchr(at, '\n') + 1, strlen(strchr(at, '\n')));
    }
}

static void same(const struct any_scene *scene, size_t output, const char *how)
{
    size_t at = 0;
    while (bytes[0][at] && bytes[0][at] == bytes[1][at])
        at++;
    if (bytes[0][at] || bytes[1][at])
        fail_msg("%s\n%s, %s: '%.60s', or '%.60s'", scene->chain.text, scene->output[output], how, bytes[0] + at, bytes[1] + at);
}

static void compare(const struct any_scene *scene, size_t output, const char *one, const char *other)
{
    read_file(one, bytes[0]);
    read_file(other, bytes[1]);
    same(scene, output, other);
}

/* The next field of a line; returns its length. */
static size_t next_field(const char **at, const char **field)
{
    const size_t length = strcspn(*at, ",\n");
    *field = *at;
    *at += length + ((*at)[length] == ',');
    return length;
}

/* What is made from a stored run has the same numbers. Its uncertainties are those of all samples, or unknown. */
static void same_later(const struct any_scene *scene, size_t output, bool known)
{
    const char *line[2] = {bytes[0], bytes[1]}, *at[2], *field[2], *name;
    for (; *line[0] && *line[1]; line[0] = strchr(line[0], '\n') + 1, line[1] = strchr(line[1], '\n') + 1) {
        const char *head = bytes[0];
        at[0] = line[0];
        at[1] = line[1];
        while (*head != '\n') {
            const char *const before = head;
            const bool uncertain = memmem(before, next_field(&head, &name), "uncertainty", 11) && line[0] != bytes[0];
            const size_t length[2] = {next_field(&at[0], &field[0]), next_field(&at[1], &field[1])};
            const double run = strtod(field[0], NULL), later = strtod(field[1], NULL);
            const bool good = uncertain
                                  ? later >= 0.99 * run || !length[0] || ((isnan(later) || !length[1]) && !known) || isnan(run)
                                  : length[0] == length[1] && memcmp(field[0], field[1], length[0]) == 0;
            if (!good)
                fail_msg("%s\n%s, stored: '%.60s', or '%.60s'", scene->chain.text, scene->output[output], field[0], field[1]);
        }
    }
    assert_true(!*line[0] && !*line[1]);
}

/* Of these a trajectory knows how far they may be off. */
static bool has_bounds(const char *output)
{
    return strstr(output, "show: sensors") || strstr(output, "show: extremes") || strstr(output, "show: profiles");
}

static void compare_later(const struct any_scene *scene, size_t output, const char *one, const char *later)
{
    read_file(one, bytes[0]);
    read_file(later, bytes[1]);
    for (int i = 0; i < 2; i++) { /* what is absorbed, and the moment of the front's arrival, only the run knows */
        drop_notes(bytes[i]);
        drop_row(bytes[i], "reflected energy,");
        drop_row(bytes[i], "clean index,");
    }
    same_later(scene, output, has_bounds(scene->output[output]));
}

static void compare_all(const struct any_scene *scene, const bool *with, const char *folder, const char *other)
{
    for (size_t o = 0; o < ANY_OUTPUTS; o++) {
        char name[20];
        snprintf(name, sizeof name, "%zu.csv", o);
        if (with[o])
            compare(scene, o, in(folder, name), in(other, name));
    }
}

static void play_together(const struct any_scene *scene, const bool *with)
{
    write_any(scene, with, false, "");
    const struct bead_counts first = play_counts((struct bead_job){.input = scene_path, .output = in("all", ""), .threads = 1});
    write_any(scene, with, true, "");
    const struct bead_counts second = play_counts((struct bead_job){
        .input = scene_path, .output = in("other", ""), .threads = 3, .instructions = "portable", .full_window = true});
    assert_int_equal(first.samples, second.samples);
    assert_int_equal(first.steps, second.steps);
    assert_int_equal(first.comparison_steps, second.comparison_steps);
    assert_int_equal(first.passes, second.passes);
    assert_true(second.evaluations >= first.evaluations);
    compare_all(scene, with, "all", "alone");
    compare_all(scene, with, "all", "other");
}

/* A trajectory of some beads and times: what it was asked for, in samples of the scene. */
struct part {
    size_t first, last, from, to;
};

static enum bead_error from_stored(const char *run, size_t output, struct bead_message *msg)
{
    char name[20];
    snprintf(name, sizeof name, "%zu.csv", output);
    unlink(in("later", name));
    return try_job((struct bead_job){.input = in("all", run), .output = in("later", name), .threads = 2}, msg);
}

/* Leaves the rows whose times, the first column, are between those of samples; returns how many. */
static size_t cut_rows(char *text, double from, double to)
{
    size_t count = 0;
    char *keep = text + strcspn(text, "\n") + 1;
    for (char *line = keep, *next; *line; line = next) {
        const double time = strtod(line, NULL);
        next = line + strcspn(line, "\n") + 1;
        if (time < from || time > to)
            continue;
        memmove(keep, line, (size_t)(next - line));
        keep += next - line;
        count++;
    }
    *keep = '\0';
    return count;
}

/* "time: is from 1.2 us to 40 us, but FILE goes from 20 us to 57.22 us only", of samples. */
static void times_are_told(const char *message, const size_t sample[4], double every)
{
    static const char *const before[4] = {"is from ", " to ", " goes from ", " to "};
    const char *at = strstr(message, "time: ");
    for (size_t i = 0; at && i < 4; i++) {
        char *unit = NULL;
        at = strstr(at, before[i]);
        const double told = at ? strtod(at + strlen(before[i]), &unit) : NAN, time = (double)sample[i] * every;
        const double by = !at || strncmp(unit, " s", 2) == 0 ? 1
                          : strncmp(unit, " ms", 3) == 0     ? 1e-3
                          : strncmp(unit, " us", 3) == 0     ? 1e-6
                                                             : 1e-9;
        if (!(fabs(told * by - time) <= 1e-3 * time))
            fail_msg("'%s': number %zu is not %g s", message, i, time);
        at = unit;
    }
}

/* Curves of places are there where the part has them, for the times that it has: a run that was stopped ends early, but none begins
 * late. */
static void play_part(const struct any_scene *scene, size_t output, const struct part *part)
{
    struct bead_message msg = {""};
    char name[20];
    const struct any_places *p = &scene->places[output];
    const enum bead_error err = from_stored("part.h5", output, &msg);
    snprintf(name, sizeof name, "%zu.csv", output);
    read_file(in("all", name), bytes[0]);
    const size_t rows = cut_rows(bytes[0], (double)part->from * scene->every, (double)part->to * scene->every);
    if (!err != (p->low >= part->first && p->high <= part->last && (!p->timed || p->from >= part->from) && rows > 0))
        fail_msg("%s\n%s of beads %zu to %zu, samples %zu to %zu: '%s'", scene->chain.text, scene->output[output], part->first,
                 part->last, part->from, part->to, msg.text);
    if (err && p->timed && p->from < part->from)
        times_are_told(msg.text, (const size_t[]){p->from, p->to, part->from, ANY_SAMPLES}, scene->every);
    if (err)
        return;
    read_file(in("later", name), bytes[1]);
    same_later(scene, output, false);
}

/* Leaves the rows of this chain, the first column, without it. */
static void leave_chain(char *text, char name)
{
    char *keep = text;
    for (char *line = text, *next; *line; line = next) {
        next = line + strcspn(line, "\n") + 1;
        char *const rest = strchr(line, ',') + 1;
        if (line != text && line[0] != name)
            continue;
        memmove(keep, rest, (size_t)(next - rest));
        keep += next - rest;
    }
    *keep = '\0';
}

/* A chain of a stored run has the rows alone that it has among others, uncertainties and all. */
static void play_chain(const struct any_scene *scene, size_t output, const char *name)
{
    struct bead_message msg = {""};
    char file[20];
    snprintf(file, sizeof file, "%zu.csv", output);
    if (try_job((struct bead_job){.input = in("all", "run.h5"), .output = in("one", file), .configuration = name, .threads = 1},
                &msg))
        fail_msg("%s\n%s of chain %s: '%s'", scene->chain.text, scene->output[output], name, msg.text);
    read_file(in("later", file), bytes[0]);
    leave_chain(bytes[0], *name);
    read_file(in("one", file), bytes[1]);
    same(scene, output, name);
}

/* Tables are made beside a trajectory, and then from it. */
static void play_later(const struct any_scene *scene, const bool *with, struct drawing *d)
{
    char last[600];
    struct part part = {.first = draw_below(d, scene->beads)};
    part.last = part.first + 1 + draw_below(d, scene->beads - part.first);
    any_time(d, 6, &part.from, &part.to); /* what is sampled each second or third time begins with the part */
    snprintf(last, sizeof last,
             "  - {trajectory: run.h5, every: %.17g s, fields: all, uncertainty: true}\n  - {trajectory: part.h5, every: %.17g s, "
             "fields: all, beads: "
             "[%zu, "
             "%zu], time: [%.17g s, %.17g s]}\n",
             scene->every, scene->every, part.first, part.last, (double)part.from * scene->every, (double)part.to * scene->every);
    write_any(scene, with, false, last);
    play_counts((struct bead_job){.input = scene_path, .output = in("all", ""), .threads = 2});
    for (size_t o = 0; o < ANY_OUTPUTS; o++) {
        struct bead_message msg = {""};
        char name[20];
        snprintf(name, sizeof name, "%zu.csv", o);
        if (!with[o])
            continue;
        const enum bead_error err = from_stored("run.h5", o, &msg);
        if (!err != !scene->of_run[o])
            fail_msg("%s\n%s: '%s'", scene->chain.text, scene->output[o], msg.text);
        if (!err)
            compare_later(scene, o, in("all", name), in("later", name));
        const bool rows = has_bounds(scene->output[o]) && !strstr(scene->output[o], "sensors");
        for (size_t c = 0; scene->chains > 1 && rows && c < scene->chains; c++)
            play_chain(scene, o, c ? "B" : "A");
        if (scene->places[o].are)
            play_part(scene, o, &part);
    }
}

static void tables_depend_on_their_scene_alone(void **)
{
    size_t possible = 0;
    struct drawing parts = {SCENES, 0};
    for (uint64_t seed = 0; seed < SCENES; seed++) {
        const struct any_scene scene = any_draw(seed);
        bool with[ANY_OUTPUTS];
        const size_t count = find_possible(&scene, with);
        possible += count;
        if (count > 0)
            play_together(&scene, with);
        if (count > 0 && seed % 2)
            play_later(&scene, with, &parts);
    }
    assert_int_equal(possible, POSSIBLE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(tables_depend_on_their_scene_alone)};
    return cmocka_run_group_tests_name("any run", tests, make_directory, remove_directory);
}
