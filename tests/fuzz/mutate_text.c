/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mutator of scenes: changes words and lines, not only bytes, so that most results are YAML. It starts from accepted texts in half
 * of all cases. */
#include <string.h>

#include "tests/fuzz/fuzz.h"

enum { MOST = 1 << 16, SPANS = 4096, ACCEPTED = 1024, KEPT = 512, LONGEST = 8192 };

struct text {
    char bytes[MOST];
    size_t size, most;
};
struct span {
    size_t from, to;
};

/* Not of malloc: libFuzzer would take what grows for leaks. */
static struct {
    uint8_t bytes[LONGEST];
    size_t size;
} accepted[ACCEPTED];
static size_t accepted_count;

static const char *const odd[] = {"0",
                                  "1",
                                  "-1",
                                  "1e-300",
                                  "1e300",
                                  "100000",
                                  "4294967296",
                                  "18446744073709551615",
                                  "-0",
                                  "nan",
                                  ".inf",
                                  "0x10",
                                  "0.5",
                                  "[1, 1]",
                                  "[]",
                                  "{}",
                                  "null",
                                  "~",
                                  "\"\"",
                                  "true",
                                  "&a x",
                                  "*a",
                                  "1 s",
                                  "1 us",
                                  "1e9 s",
                                  "1 ns",
                                  "1 m",
                                  "1 um",
                                  "1 N",
                                  "89.999 deg",
                                  "1 GPa",
                                  "1e4 m/s",
                                  "32768",
                                  "random",
                                  "\"0110\"",
                                  "auto",
                                  "all",
                                  "none",
                                  "|\n  x",
                                  "\xe2\x80\xae",
                                  "\xff",
                                  "follow",
                                  "\"\\u0000\"",
                                  "k: v",
                                  "\"\\u0007<b>&\"",
                                  "../x.png",
                                  "a/b.png",
                                  "!!int 3",
                                  "last",
                                  "[0, last]",
                                  "1/100",
                                  "1/1e-300",
                                  "{from: 1 m/s, to: 9 m/s, count: 3}",
                                  "{from: 1, to: 1000, count: 4, spacing: log}"};
static const char marks[] = "{}[]:,-\"'#&*!|>%@`\t";

static bool is_word(char c)
{
    return (unsigned char)c > ' ' && !strchr(",:[]{}\"'#", c);
}

/* Put `with` in place of a span. */
static void replace(struct text *t, struct span span, const char *with, size_t length)
{
    if (t->size - (span.to - span.from) + length > t->most)
        return;
    memmove(t->bytes + span.from + length, t->bytes + span.to, t->size - span.to);
    memcpy(t->bytes + span.from, with, length);
    t->size = t->size - (span.to - span.from) + length;
}

static size_t find_words(const struct text *t, struct span *spans)
{
    size_t count = 0;
    for (size_t i = 0, from; i < t->size && count < SPANS; i++) {
        if (!is_word(t->bytes[i]))
            continue;
        for (from = i; i < t->size && is_word(t->bytes[i]);)
            i++;
        spans[count++] = (struct span){from, i};
    }
    return count;
}

static size_t find_lines(const struct text *t, struct span *spans)
{
    size_t count = 0;
    for (size_t from = 0, i = 0; i < t->size && count < SPANS; i++) {
        if (t->bytes[i] == '\n' || i + 1 == t->size) {
            spans[count++] = (struct span){from, i + 1};
            from = i + 1;
        }
    }
    return count;
}

/* A copy of a span of the text goes to another place of it. */
static void copy(struct text *t, struct span from, struct span to)
{
    char part[1024];
    size_t length = from.to - from.from;
    if (length > sizeof part)
        return;
    memcpy(part, t->bytes + from.from, length);
    replace(t, to, part, length);
}

static void change_word(struct text *t)
{
    static struct span spans[SPANS];
    size_t count = find_words(t, spans);
    if (count == 0)
        return;
    struct span word = spans[fuzz_random((unsigned)count)];
    const char *other = odd[fuzz_random(sizeof odd / sizeof *odd)];
    if (fuzz_random(2))
        copy(t, spans[fuzz_random((unsigned)count)], word);
    else
        replace(t, word, other, strlen(other));
}

static void change_line(struct text *t)
{
    static struct span spans[SPANS];
    size_t count = find_lines(t, spans);
    if (count == 0)
        return;
    struct span line = spans[fuzz_random((unsigned)count)], other = spans[fuzz_random((unsigned)count)];
    switch (fuzz_random(4)) {
    case 0:
        replace(t, line, "", 0);
        break;
    case 1:
        copy(t, line, (struct span){other.from, other.from});
        break;
    case 2:
        replace(t, (struct span){line.from, line.from}, "  ", 2);
        break;
    default:
        if (line.to - line.from > 2 && t->bytes[line.from] == ' ')
            replace(t, (struct span){line.from, line.from + 2}, "", 0);
    }
}

static void add_mark(struct text *t)
{
    size_t at = fuzz_random((unsigned)t->size + 1);
    replace(t, (struct span){at, at}, &marks[fuzz_random(sizeof marks - 1)], 1);
}

/* The first half stays: seeds and the corpus come first. Among the others a new one takes the place of any. */
void fuzz_accept(const uint8_t *data, size_t size)
{
    if (size > LONGEST)
        return;
    size_t slot = accepted_count < ACCEPTED ? accepted_count++ : KEPT + fuzz_random(ACCEPTED - KEPT);
    memcpy(accepted[slot].bytes, data, size);
    accepted[slot].size = size;
}

/* The text to change: an accepted one, or libFuzzer's choice. */
static void begin(struct text *t, const uint8_t *data, size_t size)
{
    if (accepted_count > 0 && fuzz_random(2)) {
        size_t slot = fuzz_random((unsigned)accepted_count), other = fuzz_random((unsigned)accepted_count);
        slot = accepted[other].size < accepted[slot].size ? other : slot; /* rather short ones, which are fast */
        data = accepted[slot].bytes;
        size = accepted[slot].size < t->most ? accepted[slot].size : t->most;
    }
    memcpy(t->bytes, data, size);
    t->size = size;
}

size_t fuzz_mutate_text(uint8_t *data, size_t size, size_t most, unsigned seed)
{
    static struct text t;
    fuzz_seed(seed);
    t.most = most < MOST ? most : MOST;
    if (size > t.most || fuzz_random(8) == 0)
        return LLVMFuzzerMutate(data, size, most);
    begin(&t, data, size);
    /* A parser stops at the first error: mostly one change. */
    for (unsigned rounds = fuzz_random(4) > 0 ? 1 : 1 + fuzz_random(4); rounds > 0; rounds--) {
        unsigned kind = fuzz_random(16);
        (kind < 11 ? change_word : kind < 15 ? change_line : add_mark)(&t);
    }
    memcpy(data, t.bytes, t.size);
    return t.size;
}
