/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes with pictures: the work they skip, the same pictures for any number of threads, and the same again from a trajectory. */
#include "support.h"

#include "scratch.h"
#include "sessions.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

#include "beadreel/movie.h"
#include "beadreel/trajectory.h"
#include "render/encode/movie_internal.h"
#include "sim/kinds/output_kinds.h"

static void path_of(const char *part, const char *name, char path[512])
{
    snprintf(path, 512, "%s/%s%s%s", directory, part, *part && *name ? "/" : "", name);
}

static void empty(const char *part)
{
    char path[512];
    path_of(part, "", path);
    remove_files(path);
}

static int empty_directory(void **state)
{
    (void)state;
    static const char *const parts[] = {"a", "b", "c", ""};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        empty(parts[i]);
    return 0;
}

static size_t files_in(const char *part, const char *ending)
{
    char path[512];
    size_t count = 0;
    path_of(part, "", path);
    DIR *dir = opendir(path);
    assert_non_null(dir);
    for (struct dirent *e; (e = readdir(dir));) {
        size_t length = strlen(e->d_name);
        count += length >= strlen(ending) && strcmp(e->d_name + length - strlen(ending), ending) == 0 && e->d_name[0] != '.';
    }
    closedir(dir);
    return count;
}

/* Run a scene text into directory/part. */
static struct bead_counts play(const char *text, const char *part, int threads)
{
    char scene[512], out[512];
    write_scene(text, scene);
    path_of(part, "", out);
    return play_counts((struct bead_job){.input = scene, .output = out, .threads = threads});
}

static char *contents(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        fail_msg("%s is not there", path);
    fseek(file, 0, SEEK_END);
    *length = (size_t)ftell(file);
    rewind(file);
    char *bytes = malloc(*length + 1);
    assert_int_equal(fread(bytes, 1, *length, file), *length);
    fclose(file);
    return bytes;
}

/* Encoders are deterministic, so the same frames are the same bytes. */
static void assert_same_file(const char *part, const char *other, const char *name)
{
    char a[512], b[512];
    size_t la, lb;
    path_of(part, name, a);
    path_of(other, name, b);
    char *ca = contents(a, &la), *cb = contents(b, &lb);
    if (la != lb || memcmp(ca, cb, la) != 0)
        fail_msg("%s and %s differ", a, b);
    free(ca);
    free(cb);
}

/* Every number of two trajectories of one chain, to the bit; the scenes they store differ. */
static void assert_same_samples(const char *part, const char *other)
{
    struct bead_trajectory *t[2];
    struct bead_message msg = {""};
    const char *parts[2] = {part, other};
    for (int i = 0; i < 2; i++) {
        char path[512];
        path_of(parts[i], "run.h5", path);
        if (bead_trajectory_open(path, NULL, &t[i], &msg))
            fail_msg("%s", msg.text);
    }
    size_t samples = bead_grid_count(bead_trajectory_grid(t[0])), chains;
    size_t beads = bead_chain_beads(bead_trajectory_chains(t[0], &chains)[0]);
    unsigned fields = bead_trajectory_fields(t[0]);
    assert_int_equal(samples, bead_grid_count(bead_trajectory_grid(t[1])));
    for (size_t i = 0; i < samples; i++) {
        struct bead_sample s[2];
        for (int k = 0; k < 2; k++)
            assert_int_equal(bead_trajectory_read(t[k], i, 0, fields, &s[k], &msg), BEAD_OK);
        for (int f = 0; f < BEAD_FIELD_COUNT; f++) {
            if (s[0].field[f])
                assert_memory_equal(s[0].field[f], s[1].field[f], beads * sizeof(double));
        }
    }
    bead_trajectory_close(t[0]);
    bead_trajectory_close(t[1]);
}

#define CHAIN                                                                                                           \
    "title: Test\nchain: {beads: [{cell: [large-steel, aluminium], count: 20, spins: random, magnetism: 0.2, seed: 7}," \
    " {bead: small-steel, sensor: s}, {bead: large-steel, count: 4}], wall: brass}\n"
#define LONG CHAIN "simulate: {until: 1.5 ms, step: 1 us}\n"

static void an_image_of_some_beads_stops_with_its_time(void **state)
{
    (void)state;
    struct bead_counts counts =
        play(LONG "outputs: [{image: part.png, beads: [20, 40], time: [0, 0.5 ms], size: [300, 200]}]\n", "a", 1);
    assert_int_equal(counts.steps, 500);
    assert_int_equal(counts.passes, 1);
    assert_true(counts.samples > 0);
    assert_true(counts.sample_values < 21 * counts.samples);
    struct bead_counts whole = play(LONG "outputs: [{image: part.png, size: [300, 200]}]\n", "a", 1);
    assert_int_equal(whole.steps, 1500);
    empty("a");
}

static void a_movie_without_trajectory_writes_no_hdf5(void **state)
{
    (void)state;
    play(LONG "outputs: [{movie: m.mp4, size: [320, 180], fps: 10, duration: 1 s}]\n", "a", 2);
    assert_int_equal(files_in("a", ".mp4"), 1);
    assert_int_equal(files_in("a", ""), 1);
    empty("a");
}

static void pictures_do_not_change_the_states(void **state)
{
    (void)state;
    uint64_t hash = play(LONG "outputs: [{trajectory: run.h5, every: 2 us}]\n", "a", 1).state_hash;
    assert_true(hash ==
                play(LONG "outputs: [{trajectory: run.h5, every: 2 us}, {image: f.png}, {movie: m.mp4, size: [320, 180], fps: 10, "
                          "duration: 1 s}]\n",
                     "b", 2)
                    .state_hash);
    assert_same_samples("a", "b");
    empty("a");
    empty("b");
}

#define OUTPUTS                                                                                                      \
    "outputs: [{trajectory: run.h5, every: 2 us}, {image: f.png, size: [400, 300]}, {image: bare.png, axes: false, " \
    "size: [200, 100]}, {image: f.pdf}, {plot: s.svg, show: sensors}, {movie: m.mp4, size: [320, 180], fps: 20, "    \
    "duration: 1 s}, {movie: b.mkv, views: [beads], quality: lossless, size: [320, 180], fps: 20, duration: 1 s}, "  \
    "{image: still.png, views: [beads, profile], at: 0.4 ms, size: [640, 360]}]\n"
static const char *const names[] = {"f.png", "bare.png", "f.pdf", "s.svg", "m.mp4", "b.mkv", "still.png"};

static void threads_do_not_matter(void **state)
{
    (void)state;
    play(CHAIN OUTPUTS, "a", 1);
    play(CHAIN OUTPUTS, "b", 2);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        assert_same_file("a", "b", names[i]);
    assert_same_file("a", "b", "run.h5");
    empty("b");
}

static void a_trajectory_draws_the_same_again(void **state)
{
    (void)state;
    char run[512], out[512], made[512];
    play(CHAIN OUTPUTS, "a", 1);
    path_of("a", "run.h5", run);
    path_of("c", "", made);
    mkdir(made, 0777);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        path_of("c", names[i], out);
        play_counts((struct bead_job){.input = run, .output = out});
        assert_same_file("a", "c", names[i]);
    }
    /* Stills do not depend on what else is made of the run. */
    char scene[512];
    path_of("", "scene.yaml", scene);
    path_of("b", "", out);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strchr(names[i], 'm') == names[i] || strstr(names[i], ".mkv"))
            continue;
        play_counts((struct bead_job){.input = scene, .output = out, .only = &names[i], .only_count = 1});
        assert_same_file("a", "b", names[i]);
    }
    empty("b");
}

/* A scene without pictures can still be drawn: with an output's defaults, and the command line's options for it. */
static void a_trajectory_alone_can_be_drawn(void **state)
{
    (void)state;
    static const char *const made[] = {"x.png", "x.svg", "x.gif"};
    const char *settings[] = {"outputs.0.size=[320, 240]", "outputs.0.duration=0.5 s"};
    char run[512], out[512];
    play(CHAIN "outputs: [{trajectory: run.h5, every: 2 us}]\n", "a", 1);
    path_of("a", "run.h5", run);
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) {
        size_t length;
        path_of("a", made[i], out);
        const size_t of_a_film = strcmp(made[i], "x.gif") == 0;
        play_counts((struct bead_job){.input = run, .output = out, .settings = settings, .setting_count = 1 + of_a_film});
        free(contents(out, &length));
        assert_true(length > 1000);
    }
}

/* What scenes take for a movie is what can be encoded; hash is for tests. */
static void movies_end_like_their_codecs(void **state)
{
    (void)state;
    const char *endings = bead_output_endings(BEAD_OUTPUT_MOVIE);
    size_t taken = 0, named = 0;
    const struct bead_codec_info *codec;
    for (size_t i = 0; (codec = bead_movie_codec(i)); i++) {
        char path[32];
        snprintf(path, sizeof path, "movies.d/a.%s", codec->extension);
        bool takes = bead_output_ends_like(endings, path);
        assert_int_equal(takes, strcmp(codec->extension, "hash") != 0);
        taken += takes;
    }
    for (const char *c = endings; *c; c++)
        named += *c == '.';
    assert_int_equal(taken, named);
    assert_false(bead_output_ends_like(endings, "a.mp"));
    assert_false(bead_output_ends_like(endings, "mp4"));
    assert_false(bead_output_ends_like(endings, "a.mp4/b"));
    assert_true(bead_output_ends_like(endings, "A.MP4"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_image_of_some_beads_stops_with_its_time),
        cmocka_unit_test(a_movie_without_trajectory_writes_no_hdf5),
        cmocka_unit_test(pictures_do_not_change_the_states),
        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(a_trajectory_draws_the_same_again),
        cmocka_unit_test(a_trajectory_alone_can_be_drawn),
        cmocka_unit_test(movies_end_like_their_codecs),
    };
    return cmocka_run_group_tests_name("outputs", tests, make_directory, empty_directory);
}
