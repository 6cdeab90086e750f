/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Movies: frames read back are the ones added, at the same times and for the same duration. */
#include "movies.h"

#include <dirent.h>
#include <math.h>
#include <sys/resource.h>

#include "decode.h"
#include "render/draw/picture.h"
#include "render/encode/movie_private.h"
#include "sim/base/memory.h"

static void assert_exact(const char *name, const AVFrame *picture, const struct bead_frame *frame)
{
    for (int y = 0; y < frame->height; y++) {
        for (int x = 0; x < frame->width; x++) {
            const uint8_t *p = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
            int rgb[3];
            decoded_rgb(picture, x, y, rgb);
            if (rgb[0] != p[2] || rgb[1] != p[1] || rgb[2] != p[0])
                fail_msg("%s: pixel %d, %d is %d %d %d, not %d %d %d", name, x, y, rgb[0], rgb[1], rgb[2], p[2], p[1], p[0]);
        }
    }
}

static double luma_psnr(const AVFrame *picture, const struct bead_frame *frame)
{
    double sum = 0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const uint8_t *p = frame->pixels + (size_t)y * frame->stride + 4 * (size_t)x;
            double luma = 16 + 219 / 255.0 * (0.2126 * p[2] + 0.7152 * p[1] + 0.0722 * p[0]);
            sum += pow(picture->data[0][y * picture->linesize[0] + x] - luma, 2);
        }
    }
    return 10 * log10(255.0 * 255 * WIDTH * HEIGHT / sum);
}

/* Every player shall see: 4:2:0, BT.709, limited range, square pixels. */
static void assert_tags(const AVFrame *picture)
{
    assert_int_equal(picture->format, AV_PIX_FMT_YUV420P);
    assert_int_equal(picture->colorspace, AVCOL_SPC_BT709);
    assert_int_equal(picture->color_primaries, AVCOL_PRI_BT709);
    assert_int_equal(picture->color_trc, AVCOL_TRC_BT709);
    assert_int_equal(picture->color_range, AVCOL_RANGE_MPEG);
}

static void every_format_shows_what_was_added(void **state)
{
    (void)state;
    for (int i = 0; i < ALL; i++) {
        struct bead_movie_settings wanted = settings_of(&all[i]);
        const char *path = place(all[i].name);
        assert_int_equal(write_movie(path, &wanted, 20, 0), 20);
        struct decoded movie;
        struct bead_frame frame;
        decode(path, &movie);
        assert_string_equal(movie.codec, all[i].codec);
        assert_int_equal(movie.width, WIDTH);
        assert_int_equal(movie.height, HEIGHT);
        assert_int_equal(movie.count, 20);
        assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
        for (int f = 0; f < 20; f++) {
            assert_true(fabs(movie.time[f] - f / (double)FPS) < 0.0011); /* Matroska's unit is 1 ms */
            draw(&frame, f);
            if (all[i].psnr == 0) {
                assert_exact(all[i].name, movie.frame[f], &frame);
                continue;
            }
            assert_tags(movie.frame[f]);
            if (luma_psnr(movie.frame[f], &frame) < all[i].psnr)
                fail_msg("%s: frame %d has PSNR %g dB", all[i].name, f, luma_psnr(movie.frame[f], &frame));
        }
        bead_frame_free(&frame);
        decoded_free(&movie);
        assert_int_equal(unlink(path), 0);
    }
}

/* Frames 3, 4, 5, 9 and the last two stay as they were. They are pictures of the file all the same, at a constant rate; in drafts
 * only the very last is, and no time is lost. */
static void check_still_frames(const char *name, enum bead_quality quality)
{
    struct bead_movie_settings wanted = settings(quality);
    const char *path = place(name);
    static const int changed[] = {0, 1, 2, 6, 7, 8, 10, 11, 12, 13, 14, 16};
    bool draft = quality == BEAD_QUALITY_DRAFT;
    uint64_t encoded = write_movie(path, &wanted, 17, 1u << 3 | 1u << 4 | 1u << 5 | 1u << 9 | 1u << 15 | 1u << 16);
    assert_int_equal(encoded, draft ? 11 : 17);
    struct decoded movie;
    decode(path, &movie);
    assert_int_equal(movie.count, draft ? 12 : 17);
    for (int f = 0; f < (int)movie.count; f++)
        assert_true(fabs(movie.time[f] - (draft ? changed[f] : f) / (double)FPS) < 0.0011);
    assert_true(fabs(movie.duration - 17.0 / FPS) < 0.0011);
    assert_true(movie.said == 0 || fabs(movie.said - 17.0 / FPS) < 0.0011);
    decoded_free(&movie);
    assert_int_equal(unlink(path), 0);
}

static void still_frames_are_frames(void **state)
{
    (void)state;
    for (int i = 0; i < ALL; i++) {
        check_still_frames(all[i].name, all[i].quality);
        check_still_frames(all[i].name, BEAD_QUALITY_DRAFT);
    }
}

/* Threads of this process whose priority is `nice`. */
static int threads_of(int nice)
{
    int count = 0;
    DIR *tasks = opendir("/proc/self/task");
    assert_non_null(tasks);
    for (struct dirent *task; (task = readdir(tasks));)
        count += task->d_name[0] != '.' && getpriority(PRIO_PROCESS, (id_t)atoi(task->d_name)) == nice;
    closedir(tasks);
    return count;
}

/* What draws the frames keeps its priority; x264's threads are nicer by 10, as far as 19. */
static void drawing_comes_before_encoding(void **state)
{
    (void)state;
    const int own = getpriority(PRIO_PROCESS, 0), nicer = own + 10 < 19 ? own + 10 : 19;
    const struct bead_movie_settings wanted = settings_of(&all[0]);
    struct bead_message msg = {""};
    struct bead_movie *movie;
    const int before = threads_of(own);
    assert_int_equal(bead_movie_open(place("priority.mp4"), &wanted, &movie, &msg), BEAD_OK);
    if (nicer > own)
        assert_int_equal(threads_of(own), before);
    assert_true(threads_of(nicer) >= 2);
    bead_movie_abort(movie);
}

static void one_frame_is_a_movie(void **state)
{
    (void)state;
    for (int i = 0; i < ALL; i++) {
        struct bead_movie_settings wanted = settings_of(&all[i]);
        const char *path = place(all[i].name);
        assert_int_equal(write_movie(path, &wanted, 1, 0), 1);
        struct decoded movie;
        decode(path, &movie);
        assert_int_equal(movie.count, 1);
        assert_int_equal(movie.width, WIDTH);
        decoded_free(&movie);
        assert_int_equal(unlink(path), 0);
    }
}

/* The whole file, which is removed. */
static char *take_file(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    *size = bead_file_bytes(path);
    char *bytes = malloc(*size);
    assert_non_null(bytes);
    assert_int_equal(fread(bytes, 1, *size, file), *size);
    fclose(file);
    unlink(path);
    return bytes;
}

/* The same as write_movie, in two steps. False: this kind of movie has none. */
static bool write_in_slots(const char *path, const struct bead_movie_settings *wanted, int count, uint64_t still)
{
    enum { SLOTS = 3 };
    struct bead_movie *movie;
    struct bead_frame frame;
    struct bead_changes missing[SLOTS] = {{.count = 0}};
    bool reserved;
    assert_int_equal(bead_frame_create(wanted->width, wanted->height, &frame, NULL), BEAD_OK);
    assert_int_equal(bead_movie_open(path, wanted, &movie, NULL), BEAD_OK);
    assert_int_equal(bead_movie_reserve(movie, SLOTS, &reserved, NULL), BEAD_OK);
    for (int i = 0; reserved && i < count; i++) {
        size_t slot = (size_t)i % SLOTS;
        struct bead_changes changes = {.count = 0};
        if (!(still >> i & 1))
            changes = (struct bead_changes){1, {draw(&frame, i)}};
        for (int s = 0; changes.count && s < SLOTS; s++)
            bead_changes_add(&missing[s], changes.rect[0]);
        assert_int_equal(bead_movie_convert(movie, slot, &frame, &missing[slot], NULL), BEAD_OK);
        missing[slot].count = 0;
        assert_int_equal(bead_movie_add_slot(movie, slot, &changes, NULL), BEAD_OK);
    }
    if (reserved)
        assert_int_equal(bead_movie_close(movie, NULL, NULL), BEAD_OK);
    else
        bead_movie_abort(movie);
    bead_frame_free(&frame);
    return reserved;
}

/* Not only the same frames: the same files. No date, random number or race gets in; nor does it matter who converts. */
static void runs_give_the_same_files(void **state)
{
    (void)state;
    for (int i = 0; i < ALL; i++) {
        struct bead_movie_settings wanted = settings_of(&all[i]);
        char *bytes[3] = {NULL, NULL, NULL};
        size_t size[3];
        for (int run = 0; run < 3; run++) {
            const char *path = place(all[i].name);
            if (run == 2 && !write_in_slots(path, &wanted, 12, 1u << 5 | 1u << 11)) {
                assert_string_equal(all[i].codec, "gif");
                break;
            }
            if (run < 2)
                write_movie(path, &wanted, 12, 1u << 5 | 1u << 11);
            bytes[run] = take_file(path, &size[run]);
        }
        assert_int_equal(size[0], size[1]);
        assert_memory_equal(bytes[0], bytes[1], size[0]);
        if (bytes[2]) {
            assert_int_equal(size[0], size[2]);
            assert_memory_equal(bytes[0], bytes[2], size[0]);
        }
        for (int run = 0; run < 3; run++)
            free(bytes[run]);
    }
}

/* Large areas of one colour, as in a colour bar, keep it within 2 levels. */
static void colours_are_bt709(void **state)
{
    (void)state;
    static const int colours[8][3] = {{253, 231, 37}, {68, 1, 84}, {33, 145, 140}, {255, 255, 255},
                                      {0, 0, 0},      {255, 0, 0}, {10, 90, 250},  {94, 201, 98}};
    for (int i = 0; i < ALL; i++) {
        if (all[i].psnr == 0)
            continue;
        struct bead_movie_settings wanted = settings_of(&all[i]);
        wanted.width = 8 * 32;
        wanted.height = 32;
        struct bead_frame frame;
        struct bead_movie *movie;
        assert_int_equal(bead_frame_create(wanted.width, wanted.height, &frame, NULL), BEAD_OK);
        for (int x = 0; x < wanted.width * wanted.height; x++)
            put(&frame, x % wanted.width, x / wanted.width, colours[x / 32 % 8][0], colours[x / 32 % 8][1], colours[x / 32 % 8][2]);
        const char *path = place(all[i].name);
        assert_int_equal(bead_movie_open(path, &wanted, &movie, NULL), BEAD_OK);
        for (int f = 0; f < 3; f++)
            assert_int_equal(bead_movie_add(movie, &frame, NULL, NULL), BEAD_OK);
        assert_int_equal(bead_movie_close(movie, NULL, NULL), BEAD_OK);
        struct decoded back;
        decode(path, &back);
        assert_int_equal(back.count, 3);
        for (int c = 0; c < 8; c++) {
            const AVFrame *p = back.frame[2];
            double r = colours[c][0] / 255.0, g = colours[c][1] / 255.0, b = colours[c][2] / 255.0;
            double y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
            assert_true(fabs(p->data[0][16 * p->linesize[0] + 32 * c + 16] - (16 + 219 * y)) <= 2);
            assert_true(fabs(p->data[1][8 * p->linesize[1] + 16 * c + 8] - (128 + 224 * (b - y) / 1.8556)) <= 2);
            assert_true(fabs(p->data[2][8 * p->linesize[2] + 16 * c + 8] - (128 + 224 * (r - y) / 1.5748)) <= 2);
        }
        decoded_free(&back);
        bead_frame_free(&frame);
        unlink(path);
    }
}

static size_t read_bytes(const char *path, uint8_t *bytes, size_t most)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t size = fread(bytes, 1, most, file);
    fclose(file);
    return size;
}

static const uint8_t *find(const uint8_t *bytes, size_t size, const char *text)
{
    return memmem(bytes, size, text, strlen(text));
}

/* gif counts in 1/100 s and players slow down below 2: 60 frames a second become 30, of the same duration; it loops for ever. */
static void gif_is_playable(void **state)
{
    (void)state;
    static const int counts[] = {1, 2, 3, 8, 60, 61};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        struct bead_movie_settings wanted = settings(BEAD_QUALITY_STANDARD);
        const char *path = place("fast.gif");
        wanted.fps = 60;
        write_movie(path, &wanted, counts[i], 0);
        struct decoded movie;
        struct bead_frame frame;
        decode(path, &movie);
        if (fabs(movie.duration - counts[i] / 60.0) > 0.5 / 60)
            fail_msg("%d frames last %g s", counts[i], movie.duration);
        assert_true(movie.time[0] == 0);
        for (size_t f = 1; f + 1 < movie.count; f++)
            assert_true(movie.time[f] - movie.time[f - 1] > 0.0199);
        assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
        draw(&frame, 0);
        assert_exact("first.gif", movie.frame[0], &frame);
        draw(&frame, counts[i] - 1);
        if (counts[i] > 1)
            assert_exact("last.gif", movie.frame[movie.count - 1], &frame);
        bead_frame_free(&frame);
        decoded_free(&movie);
        uint8_t bytes[4096];
        size_t size = read_bytes(path, bytes, sizeof bytes);
        const uint8_t *loop = find(bytes, size, "NETSCAPE2.0");
        assert_non_null(loop);
        assert_memory_equal(loop + 11, "\3\1\0\0\0", 5);
        unlink(path);
    }
}

/* Noise in 200 colours that stays, and a square that moves and has new colours in every frame: of the noise only the first frame
 * has all. */
static void gif_has_only_what_changes(void **state)
{
    (void)state;
    const char *path = place("noise.gif");
    struct bead_movie_settings wanted = settings(BEAD_QUALITY_STANDARD);
    struct bead_movie *movie;
    struct bead_frame frame;
    uint32_t noise = 1;
    assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        noise = noise * 1664525 + 1013904223;
        int colour = (int)(noise >> 16) % 200;
        put(&frame, i % WIDTH, i / WIDTH, colour, 255 - colour, colour / 2);
    }
    assert_int_equal(bead_movie_open(path, &wanted, &movie, NULL), BEAD_OK);
    for (int f = 0; f < 20; f++) {
        for (int i = 0; i < 64; i++)
            put(&frame, 4 * f + i % 8, 20 + i / 8, 255, 12 * f, 4 * (i % 8));
        assert_int_equal(bead_movie_add(movie, &frame, NULL, NULL), BEAD_OK);
    }
    uint64_t bytes;
    assert_int_equal(bead_movie_close(movie, &bytes, NULL), BEAD_OK);
    if (bytes > 2 * WIDTH * HEIGHT)
        fail_msg("%llu bytes", (unsigned long long)bytes);
    bead_frame_free(&frame);
    unlink(path);
}

static void apng_loops_for_ever(void **state)
{
    (void)state;
    struct bead_movie_settings wanted = settings(BEAD_QUALITY_STANDARD);
    const char *path = place("loop.png");
    write_movie(path, &wanted, 9, 0);
    uint8_t bytes[4096];
    const uint8_t *control = find(bytes, read_bytes(path, bytes, sizeof bytes), "acTL");
    assert_non_null(control);
    assert_memory_equal(control + 4, "\0\0\0\11\0\0\0\0", 8);
    unlink(path);
}

static size_t number(const uint8_t *bytes, int count)
{
    size_t value = 0;
    while (count-- > 0)
        value = value << 8 | bytes[count];
    return value;
}

/* The first frame of the loop alone, as a separate file. */
static void write_webp_frame(const uint8_t *frame, size_t size)
{
    FILE *file = fopen(place("frame.webp"), "wb");
    const uint32_t bytes = (uint32_t)size + 4;
    assert_non_null(file);
    fwrite("RIFF", 1, 4, file);
    fwrite(&bytes, sizeof bytes, 1, file);
    fwrite("WEBP", 1, 4, file);
    fwrite(frame, 1, size, file);
    assert_int_equal(fclose(file), 0);
}

/* By the container's specification, as FFmpeg reads no loops: they run for ever, each frame for its time, and the first is whole.
 */
static void webp_is_a_loop(void **state)
{
    (void)state;
    enum { CHUNK = 8, FRAME = 16, FRAMES = 20 };
    for (enum bead_quality quality = BEAD_QUALITY_DRAFT; quality <= BEAD_QUALITY_LOSSLESS; quality++) {
        struct bead_movie_settings wanted = settings(quality);
        const char *path = place("loop.webp");
        size_t size, frames = 0, lasting = 0;
        write_movie(path, &wanted, FRAMES, 0);
        BEAD_FREED uint8_t *bytes = (uint8_t *)take_file(path, &size);
        assert_memory_equal(bytes + 8, "WEBP", 4);
        for (size_t at = 12; at + CHUNK <= size; at += CHUNK + number(bytes + at + 4, 4) + number(bytes + at + 4, 1) % 2) {
            const uint8_t *chunk = bytes + at + CHUNK;
            if (memcmp(bytes + at, "ANIM", 4) == 0)
                assert_int_equal(number(chunk + 4, 2), 0); /* loops */
            if (memcmp(bytes + at, "ANMF", 4) != 0)
                continue;
            lasting += number(chunk + 12, 3);
            if (frames++ == 0)
                write_webp_frame(chunk + FRAME, number(bytes + at + 4, 4) - FRAME);
        }
        assert_int_equal(frames, FRAMES);
        assert_int_equal(lasting, FRAMES * 1000 / FPS);
        struct decoded first;
        struct bead_frame frame;
        decode(place("frame.webp"), &first);
        assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
        draw(&frame, 0);
        if (quality == BEAD_QUALITY_LOSSLESS)
            assert_exact("lossless.webp", first.frame[0], &frame);
        else
            assert_true(luma_psnr(first.frame[0], &frame) > 30);
        bead_frame_free(&frame);
        decoded_free(&first);
        unlink(place("frame.webp"));
    }
}

static void mp4_starts_fast_and_has_a_title(void **state)
{
    (void)state;
    static const char *const names[] = {"title.mp4", "title.mkv", "title.webm"};
    for (size_t i = 0; i < 3; i++) {
        struct bead_movie_settings wanted = settings(BEAD_QUALITY_STANDARD);
        wanted.title = "Clean, and \"delocalised\": 100 % \xc2\xb5s";
        wanted.comment = "beadreel";
        const char *path = place(names[i]);
        write_movie(path, &wanted, 9, 0);
        struct decoded movie;
        decode(path, &movie);
        assert_string_equal(movie.title, wanted.title);
        decoded_free(&movie);
        uint8_t bytes[65536];
        size_t size = read_bytes(path, bytes, sizeof bytes);
        assert_true(i > 0 || find(bytes, size, "moov") < find(bytes, size, "mdat"));
        unlink(path);
    }
}

/* A run that ends before there is a poster. */
static void covers_that_never_come_do_no_harm(void **state)
{
    (void)state;
    struct bead_movie_settings wanted = settings(BEAD_QUALITY_STANDARD);
    struct decoded movie;
    wanted.cover = true;
    for (int i = 0; i < ALL; i++) {
        if (all[i].quality != BEAD_QUALITY_STANDARD)
            continue;
        write_movie(place(all[i].name), &wanted, 20, 0);
        decode(place(all[i].name), &movie);
        assert_int_equal(movie.count, 20);
        assert_int_equal(movie.covers, 0);
        decoded_free(&movie);
        remove(place(all[i].name));
    }
}

static void rates_need_not_be_whole(void **state)
{
    (void)state;
    static const double rates[] = {23.976, 12.5, 0.5, 60000 / 1001.0, 1000};
    for (size_t r = 0; r < sizeof rates / sizeof *rates; r++) {
        struct bead_movie_settings wanted = settings(BEAD_QUALITY_DRAFT);
        wanted.fps = rates[r];
        const char *path = place("rate.mp4");
        write_movie(path, &wanted, 40, 1u << 20);
        struct decoded movie;
        decode(path, &movie);
        assert_true(fabs(movie.said - 40 / rates[r]) < 0.1 / rates[r] + 1e-6);
        decoded_free(&movie);
        unlink(path);
    }
}

/* Files whose muxers write no comments have one all the same, of any length, and play. */
static void every_movie_has_a_comment(void **state)
{
    (void)state;
    static const char *const names[] = {"note.gif", "note.apng", "note.mp4", "note.mkv", "note.webm"};
    char text[1001] = "";
    for (size_t i = 0; i < sizeof text - 1; i++)
        text[i] = (char)('a' + i % 26);
    for (size_t n = 0; n < sizeof names / sizeof names[0]; n++) {
        struct bead_movie_settings wanted = settings(BEAD_QUALITY_STANDARD);
        struct decoded movie;
        size_t size, shown = 0;
        wanted.comment = text;
        const char *path = place(names[n]);
        write_movie(path, &wanted, 5, 0);
        decode(path, &movie);
        assert_int_equal(movie.count, 5);
        char *bytes = take_file(path, &size);
        for (size_t at = 0; at + 20 < size; at++) /* a GIF's comment is cut into pieces */
            shown += memcmp(bytes + at, "abcdefghijklmnopqrst", 20) == 0;
        assert_in_range(shown, 1000 / 26 - 6, 1000 / 26);
        free(bytes);
        decoded_free(&movie);
    }
}

/* One line for each frame added, still or not, as the pixels are. */
static void hashes_are_of_the_frames(void **state)
{
    (void)state;
    struct bead_movie_settings wanted = settings(BEAD_QUALITY_DRAFT);
    const char *path = place("run.hash");
    assert_int_equal(write_movie(path, &wanted, 5, 1u << 2), 5);
    struct bead_frame frame;
    assert_int_equal(bead_frame_create(WIDTH, HEIGHT, &frame, NULL), BEAD_OK);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    for (int i = 0; i < 5; i++) {
        char line[64], hash[64];
        assert_non_null(fgets(line, sizeof line, file));
        if (i != 2)
            draw(&frame, i);
        snprintf(hash, sizeof hash, "%016llx\n", (unsigned long long)bead_frame_hash(&frame));
        assert_string_equal(line, hash);
    }
    assert_int_equal(fgetc(file), EOF);
    fclose(file);
    bead_frame_free(&frame);
    unlink(path);
}

static void odd_sizes_are_exact_where_they_can_be(void **state)
{
    (void)state;
    static const char *const names[] = {"odd.mp4", "odd.mkv", "odd.webm", "odd.gif", "odd.png"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        struct bead_movie_settings wanted = settings(BEAD_QUALITY_LOSSLESS);
        wanted.width = 51;
        wanted.height = 53;
        const char *path = place(names[i]);
        write_movie(path, &wanted, 3, 0);
        struct decoded movie;
        struct bead_frame frame;
        decode(path, &movie);
        assert_int_equal(bead_frame_create(51, 53, &frame, NULL), BEAD_OK);
        draw(&frame, 0);
        draw(&frame, 2);
        assert_exact(names[i], movie.frame[2], &frame);
        bead_frame_free(&frame);
        decoded_free(&movie);
        unlink(path);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format_shows_what_was_added),
        cmocka_unit_test(still_frames_are_frames),
        cmocka_unit_test(drawing_comes_before_encoding),
        cmocka_unit_test(one_frame_is_a_movie),
        cmocka_unit_test(runs_give_the_same_files),
        cmocka_unit_test(colours_are_bt709),
        cmocka_unit_test(gif_is_playable),
        cmocka_unit_test(gif_has_only_what_changes),
        cmocka_unit_test(apng_loops_for_ever),
        cmocka_unit_test(webp_is_a_loop),
        cmocka_unit_test(mp4_starts_fast_and_has_a_title),
        cmocka_unit_test(every_movie_has_a_comment),
        cmocka_unit_test(covers_that_never_come_do_no_harm),
        cmocka_unit_test(rates_need_not_be_whole),
        cmocka_unit_test(hashes_are_of_the_frames),
        cmocka_unit_test(odd_sizes_are_exact_where_they_can_be),
    };
    return cmocka_run_group_tests_name("movie", tests, make_directory, remove_directory);
}
