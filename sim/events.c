#include "sim/events.h"

#include <stddef.h>

#include "sim/stepper.h"

enum bead_error bead_events_create(const struct bead_stepper *stepper, struct bead_events **events, struct bead_message *msg)
{
    (void)stepper;
    *events = NULL;
    return bead_fail(msg, BEAD_ERROR_UNSUPPORTED, "no contact-event correction yet");
}

void bead_events_destroy(struct bead_events *events)
{
    (void)events;
}

void bead_events_correct(struct bead_events *events, struct bead_stepper *stepper)
{
    (void)events;
    (void)stepper;
}
