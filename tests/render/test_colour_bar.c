/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The colour bar explains the colours: in movies, its colours are those of the map, at their places, in BT.709. */
#include "movies.h"

#include <math.h>

#include "decode.h"
#include "render/encode/pictures.h"
#include "render/movie/composer_private.h"

enum { INSET = 4 }; /* px of the bar's edges, where its outline is */

static void require(enum bead_error err, const struct bead_message *msg)
{
    if (err)
        fail_msg("%s", msg->text);
}

struct barred {
    struct bead_scene *scene;
    struct bead_chain *chain;
    struct bead_composer *composer;
};

/* A frame of a movie with this colour map. */
static struct barred make_frame(const char *map)
{
    struct barred b;
    struct bead_message msg = {""};
    char text[256];
    snprintf(text, sizeof text,
             "chain: {beads: [{bead: large-steel, count: 9}], wall: brass}\n"
             "outputs: [{movie: a.mp4, views: [profile, spacetime], colormap: %s}]\n",
             map);
    require(bead_scene_parse("test", text, strlen(text), NULL, &b.scene, &msg), &msg);
    require(bead_chain_create(b.scene, 0, &b.chain, &msg), &msg);
    const struct bead_chain *const chains[] = {b.chain};
    struct bead_composer_setup setup = {.output = &b.scene->outputs[0],
                                        .chains = chains,
                                        .chain_count = 1,
                                        .width = 1280,
                                        .height = 720,
                                        .time = {0, 1e-3},
                                        .step = 1e-5,
                                        .range = {.high = 40},
                                        .scene = b.scene};
    require(bead_composer_create(&setup, &b.composer, &msg), &msg);
    b.composer->setup.chains = (const struct bead_chain *const *)&b.chain;
    require(bead_composer_open(b.composer, &msg), &msg);
    double force[10] = {0};
    struct bead_sample sample = {.active = 9};
    sample.field[BEAD_FIELD_FORCE] = force;
    struct bead_changes changes = {0};
    require(bead_composer_feed(b.composer, &sample, &msg), &msg);
    require(bead_composer_draw(b.composer, 0, &changes, &msg), &msg);
    return b;
}

static void free_frame(struct barred *b)
{
    bead_composer_close(b->composer);
    bead_composer_destroy(b->composer);
    bead_chain_destroy(b->chain);
    bead_scene_free(b->scene);
}

/* The map's colour of a row of the picture: 256 bands of equal height, the largest value at the top. */
static const uint8_t *colour_of(const struct barred *b, int y)
{
    const struct bead_rect *bar = &b->composer->layout.bar;
    int band = 255 - (int)floor(256 * (y + 0.5 - bar->y) / bar->height);
    return b->composer->map.rgb[band < 0 ? 0 : band > 255 ? 255 : band];
}

/* Y, Cb and Cr of a colour, not rounded. */
static void bt709(const uint8_t rgb[3], double yuv[3])
{
    double r = rgb[0] / 255.0, g = rgb[1] / 255.0, b = rgb[2] / 255.0, y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    yuv[0] = 16 + 219 * y;
    yuv[1] = 128 + 224 * (b - y) / 1.8556;
    yuv[2] = 128 + 224 * (r - y) / 1.5748;
}

/* Largest and mean distance of a 4:2:0 picture's bar from that. */
static void compare(const struct barred *b, const AVFrame *picture, double *most, double *mean)
{
    const struct bead_rect *bar = &b->composer->layout.bar;
    double sum = 0;
    size_t count = 0;
    *most = 0;
    assert_int_equal(picture->format, AV_PIX_FMT_YUV420P);
    for (int y = bar->y + INSET; y < bar->y + bar->height - INSET; y++) {
        double want[3], above[3], below[3];
        bt709(colour_of(b, y), want);
        bt709(colour_of(b, y / 2 * 2), above);
        bt709(colour_of(b, y / 2 * 2 + 1), below);
        for (int x = bar->x + INSET; x < bar->x + bar->width - INSET; x++) {
            double off = fabs(picture->data[0][y * picture->linesize[0] + x] - want[0]);
            for (int c = 1; c < 3; c++)
                off = fmax(off, fabs(picture->data[c][y / 2 * picture->linesize[c] + x / 2] - 0.5 * (above[c] + below[c])));
            *most = fmax(*most, off);
            sum += off;
            count++;
        }
    }
    assert_true(count > 500);
    *mean = sum / (double)count;
}

static const char *const maps[] = {"inferno", "viridis", "vik"};
enum { MAPS = sizeof maps / sizeof *maps };

/* As encoders get them: only rounding. */
static void planes_for_encoders_have_the_colours_of_the_map(void **state)
{
    (void)state;
    for (int m = 0; m < MAPS; m++) {
        struct barred b = make_frame(maps[m]);
        const struct bead_frame *frame = bead_composer_frame(b.composer);
        const struct bead_rect *bar = &b.composer->layout.bar;
        for (int y = bar->y + INSET; y < bar->y + bar->height - INSET; y++) {
            const uint8_t *p = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)(bar->x + bar->width / 2),
                          *rgb = colour_of(&b, y);
            if (p[0] != rgb[2] || p[1] != rgb[1] || p[2] != rgb[0])
                fail_msg("%s: row %d of the bar is not the colour of the map", maps[m], y - bar->y);
        }
        AVFrame *picture = av_frame_alloc();
        assert_non_null(picture);
        picture->format = AV_PIX_FMT_YUV420P;
        picture->width = frame->width;
        picture->height = frame->height;
        assert_int_equal(av_frame_get_buffer(picture, 64), 0);
        struct bead_rect whole = {0, 0, frame->width, frame->height};
        bead_convert_find(AV_PIX_FMT_YUV420P)(frame, bead_convert_align(frame, whole), picture);
        double most, mean;
        compare(&b, picture, &most, &mean);
        if (most > 0.55)
            fail_msg("%s: the planes are off by %g", maps[m], most);
        av_frame_free(&picture);
        free_frame(&b);
    }
}

/* And as a player sees them: 3 of the 219 levels from black to white are 1.4 of lightness, where 2.3 are just noticeable (Mahy,
 * Van Eycken and Oosterlinck, Color Research and Application 19, 105, 1994). */
static void movies_have_the_colours_of_the_map(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        enum bead_quality quality;
    } kinds[] = {{"bar.mp4", BEAD_QUALITY_HIGH},     {"bar.mp4", BEAD_QUALITY_STANDARD}, {"bar.mkv", BEAD_QUALITY_HIGH},
                 {"bar.mkv", BEAD_QUALITY_STANDARD}, {"bar.webm", BEAD_QUALITY_HIGH},    {"bar.webm", BEAD_QUALITY_STANDARD}};
    for (size_t k = 0; k < MAPS * sizeof kinds / sizeof *kinds; k++) {
        size_t kind = k / MAPS;
        struct barred b = make_frame(maps[k % MAPS]);
        const struct bead_frame *frame = bead_composer_frame(b.composer);
        struct bead_movie_settings wanted = {
            .size = sizeof wanted, .width = frame->width, .height = frame->height, .fps = FPS, .quality = kinds[kind].quality};
        struct bead_movie *movie;
        struct bead_message msg = {""};
        const char *path = place(kinds[kind].name);
        require(bead_movie_open(path, &wanted, &movie, &msg), &msg);
        for (int f = 0; f < 3; f++)
            require(bead_movie_add(movie, frame, NULL, &msg), &msg);
        require(bead_movie_close(movie, NULL, &msg), &msg);
        struct decoded back;
        double most, mean;
        decode(path, &back);
        compare(&b, back.frame[back.count - 1], &most, &mean);
        if (most > (kinds[kind].quality == BEAD_QUALITY_HIGH ? 2 : 3) || mean > 1)
            fail_msg("%s, quality %d, %s: %g levels off, %g on average", kinds[kind].name, (int)kinds[kind].quality, maps[k % MAPS],
                     most, mean);
        decoded_free(&back);
        unlink(path);
        free_frame(&b);
    }
}

/* Lossless ones keep RGB. */
static void lossless_movies_have_them_exactly(void **state)
{
    (void)state;
    static const char *const names[] = {"bar.mp4", "bar.mkv", "bar.png"};
    struct barred b = make_frame("inferno");
    const struct bead_frame *frame = bead_composer_frame(b.composer);
    const struct bead_rect *bar = &b.composer->layout.bar;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct bead_movie_settings wanted = {
            .size = sizeof wanted, .width = frame->width, .height = frame->height, .fps = FPS, .quality = BEAD_QUALITY_LOSSLESS};
        struct bead_movie *movie;
        struct bead_message msg = {""};
        require(bead_movie_open(place(names[i]), &wanted, &movie, &msg), &msg);
        require(bead_movie_add(movie, frame, NULL, &msg), &msg);
        require(bead_movie_close(movie, NULL, &msg), &msg);
        struct decoded back;
        decode(place(names[i]), &back);
        for (int y = bar->y + INSET; y < bar->y + bar->height - INSET; y++) {
            const uint8_t *want = colour_of(&b, y);
            int rgb[3];
            decoded_rgb(back.frame[0], bar->x + bar->width / 2, y, rgb);
            if (rgb[0] != want[0] || rgb[1] != want[1] || rgb[2] != want[2])
                fail_msg("%s: row %d of the bar is %d %d %d", names[i], y - bar->y, rgb[0], rgb[1], rgb[2]);
        }
        decoded_free(&back);
        unlink(place(names[i]));
    }
    free_frame(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_for_encoders_have_the_colours_of_the_map),
        cmocka_unit_test(movies_have_the_colours_of_the_map),
        cmocka_unit_test(lossless_movies_have_them_exactly),
    };
    return cmocka_run_group_tests_name("colour bar", tests, make_directory, remove_directory);
}
