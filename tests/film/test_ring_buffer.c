/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pipes: order, bounds, one worker, and no endless waiting. */
#include "render/movie/ring_buffer.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include <cmocka.h>

enum { STARTED = -1, NEVER = -2 };

struct worker {
    long fail_at; /* index of the slot whose work fails; STARTED: the first call; NEVER */
    bool fail_end, slow;
    uint64_t starts, works, ends;
    int last;
    uint64_t sum;
    bool in_order;
    pthread_t thread;
    bool same_thread;
};

struct slot {
    uint64_t index, value;
    uint64_t seen; /* times this slot has been worked on: slots come back as they were left */
};

static enum bead_error work(void *context, void *slot, int last, struct bead_message *msg)
{
    struct worker *w = context;
    if (!slot && !last) {
        w->starts++;
        w->thread = pthread_self();
        w->same_thread = true;
        return w->fail_at == STARTED ? bead_fail(msg, BEAD_ERROR_GRAPHICS, "no start") : BEAD_OK;
    }
    w->same_thread &= pthread_equal(w->thread, pthread_self()) != 0;
    if (!slot) {
        w->ends++;
        w->last = last;
        return w->fail_end ? bead_fail(msg, BEAD_ERROR_IO, "no end") : BEAD_OK;
    }
    struct slot *s = slot;
    if (w->slow)
        nanosleep(&(struct timespec){0, 200000}, NULL);
    w->in_order &= s->index == w->works && !w->ends;
    w->sum = w->sum * 31 + s->value;
    s->seen++;
    if ((long)w->works++ == w->fail_at)
        return bead_fail(msg, BEAD_ERROR_CODEC, "slot %llu", (unsigned long long)s->index);
    return BEAD_OK;
}

/* Push `count` slots; returns how many were taken. */
static uint64_t push(struct bead_ring_buffer *ring, uint64_t count)
{
    for (uint64_t i = 0; i < count; i++) {
        struct slot *slot = bead_ring_buffer_slot(ring);
        if (!slot)
            return i;
        assert_int_equal((uintptr_t)slot % 64, 0);
        assert_ptr_equal(slot, bead_ring_buffer_slot(ring)); /* asking again gives the same one */
        slot->index = i;
        slot->value = i * i + 7;
        bead_ring_buffer_submit(ring);
        bead_ring_buffer_submit(ring); /* nothing is held: nothing happens */
    }
    return count;
}

static struct bead_ring_buffer *create(struct worker *worker, size_t slots, int threads)
{
    struct bead_ring_buffer *ring;
    *worker = (struct worker){.fail_at = worker->fail_at, .fail_end = worker->fail_end, .slow = worker->slow, .in_order = true};
    assert_int_equal(bead_ring_buffer_create(slots, sizeof(struct slot), threads, work, worker, &ring, NULL), BEAD_OK);
    return ring;
}

static void same_result_for_any_thread_and_slot_count(void **state)
{
    (void)state;
    uint64_t sum = 0;
    for (int threads = 0; threads <= 2; threads++) {
        for (size_t slots = 1; slots <= 5; slots += 2) {
            struct worker w = {.fail_at = NEVER};
            struct bead_ring_buffer *ring = create(&w, slots, threads);
            assert_int_equal(push(ring, 1000), 1000);
            assert_int_equal(bead_ring_buffer_finish(ring, NULL), BEAD_OK);
            bead_ring_buffer_destroy(ring);
            assert_true(w.in_order && w.same_thread);
            assert_true(pthread_equal(w.thread, pthread_self()) == (threads == 1));
            assert_int_equal(w.starts, 1);
            assert_int_equal(w.works, 1000);
            assert_int_equal(w.ends, 1);
            assert_int_equal(w.last, BEAD_RING_DONE);
            sum = sum ? sum : w.sum;
            assert_int_equal(w.sum, sum);
        }
    }
}

static void producer_waits_for_a_slow_worker(void **state)
{
    (void)state;
    struct worker w = {.fail_at = NEVER, .slow = true};
    struct bead_ring_buffer *ring = create(&w, 2, 2);
    assert_int_equal(push(ring, 100), 100);
    assert_int_equal(bead_ring_buffer_finish(ring, NULL), BEAD_OK);
    bead_ring_buffer_destroy(ring);
    assert_int_equal(w.works, 100);
    assert_true(w.in_order);
}

/* Whatever call fails, the producer gets NULL soon, finish the first error, and the worker its last call. */
static void failures_reach_the_producer(void **state)
{
    (void)state;
    static const long at[] = {STARTED, 0, 1, 2, 7, 99};
    for (int threads = 1; threads <= 2; threads++) {
        for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
            for (int fail_end = 0; fail_end <= 1; fail_end++) {
                struct worker w = {.fail_at = at[i], .fail_end = fail_end};
                struct bead_ring_buffer *ring = create(&w, 3, threads);
                uint64_t taken = push(ring, 100);
                struct bead_message msg = {""};
                assert_int_equal(bead_ring_buffer_finish(ring, &msg), at[i] == STARTED ? BEAD_ERROR_GRAPHICS : BEAD_ERROR_CODEC);
                char text[32];
                snprintf(text, sizeof text, "slot %ld", at[i]);
                assert_string_equal(msg.text, at[i] == STARTED ? "no start" : text);
                bead_ring_buffer_destroy(ring);
                assert_int_equal(w.works, at[i] + 1);
                assert_true(taken <= (uint64_t)(at[i] + 1 + 3));
                assert_int_equal(w.ends, 1);
                assert_int_equal(w.last, BEAD_RING_ABANDONED);
            }
        }
    }
}

static void an_error_at_the_end_is_told(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 2; threads++) {
        struct worker w = {.fail_at = NEVER, .fail_end = true};
        struct bead_ring_buffer *ring = create(&w, 3, threads);
        assert_int_equal(push(ring, 10), 10);
        struct bead_message msg = {""};
        assert_int_equal(bead_ring_buffer_finish(ring, &msg), BEAD_ERROR_IO);
        assert_string_equal(msg.text, "no end");
        assert_null(bead_ring_buffer_slot(ring));
        bead_ring_buffer_destroy(ring);
        assert_int_equal(w.last, BEAD_RING_DONE);
    }
}

static void destroy_throws_the_rest_away(void **state)
{
    (void)state;
    for (int threads = 1; threads <= 2; threads++) {
        for (uint64_t count = 0; count < 4; count++) {
            struct worker w = {.fail_at = NEVER, .slow = true};
            struct bead_ring_buffer *ring = create(&w, 4, threads);
            assert_int_equal(push(ring, count), count);
            if (count & 1)
                assert_non_null(bead_ring_buffer_slot(ring)); /* taken, never submitted */
            bead_ring_buffer_destroy(ring);
            assert_true(w.works <= count);
            assert_int_equal(w.ends, 1);
            assert_int_equal(w.last, BEAD_RING_ABANDONED);
        }
    }
    bead_ring_buffer_destroy(NULL);
}

static void slots_are_zeroed_and_come_back_as_left(void **state)
{
    (void)state;
    struct worker w = {.fail_at = NEVER};
    struct bead_ring_buffer *ring = create(&w, 2, 1);
    for (uint64_t i = 0; i < 6; i++) {
        struct slot *slot = bead_ring_buffer_slot(ring);
        assert_int_equal(slot->seen, i / 2);
        slot->index = i;
        bead_ring_buffer_submit(ring);
    }
    assert_int_equal(bead_ring_buffer_finish(ring, NULL), BEAD_OK);
    bead_ring_buffer_destroy(ring);
}

static void absurd_sizes_are_refused(void **state)
{
    (void)state;
    struct worker w = {.fail_at = NEVER};
    struct bead_ring_buffer *ring = (struct bead_ring_buffer *)&w;
    struct bead_message msg = {""};
    assert_int_equal(bead_ring_buffer_create(SIZE_MAX / 2, 1024, 2, work, &w, &ring, &msg), BEAD_ERROR_MEMORY);
    assert_null(ring);
    assert_true(msg.text[0] != '\0');
    assert_int_equal(bead_ring_buffer_create(2, SIZE_MAX, 2, work, &w, &ring, &msg), BEAD_ERROR_MEMORY);
    assert_int_equal(w.starts, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(same_result_for_any_thread_and_slot_count),
        cmocka_unit_test(producer_waits_for_a_slow_worker),
        cmocka_unit_test(failures_reach_the_producer),
        cmocka_unit_test(an_error_at_the_end_is_told),
        cmocka_unit_test(destroy_throws_the_rest_away),
        cmocka_unit_test(slots_are_zeroed_and_come_back_as_left),
        cmocka_unit_test(absurd_sizes_are_refused),
    };
    return cmocka_run_group_tests_name("ring", tests, NULL, NULL);
}
