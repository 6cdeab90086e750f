/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `drive`: a force on a bead, or its displacement, as a function of time. */
#include <math.h>
#include <stdlib.h>

#include "sim/base/memory.h"
#include "sim/chain/drive.h"
#include "sim/kinds/waves.h"
#include "sim/scene/scene_private.h"

#define DRIVE(member) offsetof(struct bead_drive, member)

static const char wave_shape[] =
    "sine, chirp, noise, a file such as {file: scope.csv, columns: [1, 2]}, or points `time value, ...`";

static enum bead_error read_wave(struct bead_reader *reader, const struct bead_at *at, struct bead_drive *drive,
                                 enum bead_wave *wave)
{
    static const char *const words[] = {"", "sine", "chirp", "noise"};
    const char *text;
    BEAD_TRY(bead_read_scalar(reader, at, wave_shape, &text));
    *wave = BEAD_WAVE_POINTS;
    for (enum bead_wave w = BEAD_WAVE_SINE; w <= BEAD_WAVE_NOISE; w++)
        *wave = strcmp(words[w], text) == 0 ? w : *wave;
    return *wave == BEAD_WAVE_POINTS && !drive->points
               ? bead_wave_points_read(reader, at, wave_shape, &drive->points, &drive->point_count)
               : BEAD_OK;
}

static BEAD_OPTION_READER(read_displacement)
{
    struct bead_drive *drive = settings;
    BEAD_FREED double *work = NULL;
    BEAD_TRY(read_wave(reader, at, drive, &drive->displacement));
    if (!drive->points)
        return BEAD_OK;
    BEAD_TRY(bead_new(&work, drive->point_count, reader->msg, "a wave"));
    bead_wave_spline(drive->points, drive->point_count, work);
    return BEAD_OK;
}

static BEAD_OPTION_READER(read_force)
{
    struct bead_drive *drive = settings;
    return read_wave(reader, at, drive, &drive->force);
}

/* `displacement` and `force` are read before, and determine its unit. */
static BEAD_OPTION_READER(read_amplitude)
{
    struct bead_drive *drive = settings;
    const struct bead_option number = {
        .type = BEAD_OPTION_NUMBER, .unit = drive->force ? "N" : "m", .low = 0, .high = 1e12, .open = BEAD_OPEN_LOW};
    return bead_read_number(reader, at, &number, &drive->amplitude);
}

static const double last_bead = 1e9;
static const struct bead_option drive_rows[] = {
    {"bead", BEAD_OPTION_COUNT, DRIVE(bead), .initial = "0", .low = 0, .high = 1e9, .word = "last", .word_value = 1e9,
     .help = "which bead; 0 is the striker, which touches the first", .example = "last"},
    {"displacement", BEAD_OPTION_CUSTOM, DRIVE(displacement), .shape = wave_shape, .like = "text|chain.drive.file",
     .read = read_displacement,
     .help = "its displacement is this wave, whatever pushes it: a sine, a chirp (a sine whose frequency changes evenly until the "
             "end of the run), random noise, or a cubic spline through the points of a file, which is level at both ends",
     .example = "sine"},
    {"force", BEAD_OPTION_CUSTOM, DRIVE(force), .shape = wave_shape, .like = "text|chain.drive.file", .read = read_force,
     .help = "a force on it is this wave; positive: towards the wall; straight lines between the points of a file. Steps end at "
             "each point",
     .example = "{file: scope.csv, columns: [time, force]}"},
    {"amplitude", BEAD_OPTION_CUSTOM, .required = true, .shape = "a length for `displacement`, a force for `force`",
     .like = "number", .read = read_amplitude, .help = "amplitude; standard deviation of noise; what 1 means in a file",
     .example = "0.1 um"},
    {"frequency", BEAD_OPTION_NUMBER, DRIVE(frequency), .unit = "Hz", .low = 0, .high = 1e12, .open = BEAD_OPEN_LOW,
     .help = "frequency, except for files; of a chirp, that at time 0; of noise, about the highest", .example = "5 kHz"},
    {"to", BEAD_OPTION_NUMBER, DRIVE(to), .unit = "Hz", .low = 0, .high = 1e12, .open = BEAD_OPEN_LOW, .initial = "1 Hz",
     .help = "of a chirp: frequency at the end of the run", .example = "20 kHz"},
    {"ramp", BEAD_OPTION_NUMBER, DRIVE(ramp), .unit = "s", .initial = "0 s", .low = 0, .high = 1e6,
     .help = "time in which the amplitude rises from 0", .example = "1 ms"},
    {"seed", BEAD_OPTION_SEED, DRIVE(seed), .initial = "0", .help = "seed of noise; the same seed gives the same noise",
     .example = "7"},
};
const struct bead_options bead_drive_options = {"chain.drive", "a bead that is driven; needs simulate.until",
                                                BEAD_OPTIONS(drive_rows), NULL, NULL};

BEAD_OPTION_READER(bead_scene_read_drive)
{
    struct bead_chain_spec *chain = settings;
    struct bead_drive *drive = &chain->drive;
    const struct bead_at map = *at->up, striker = bead_at_key(&map, "striker");
    const size_t last = bead_scene_count_beads(chain);
    BEAD_TRY(bead_options_read(reader, at, &bead_drive_options, drive));
    if (!drive->displacement == !drive->force)
        return bead_wrong(reader, at, "must have either `displacement` or `force`, such as `force: sine`");
    const bool measured = drive->point_count > 0;
    if (measured == bead_given(at, "frequency"))
        return BEAD_WRONG_KEY(reader, at, "frequency", measured ? "belongs to waves that are not from a file" : "is missing");
    const bool chirp = drive->displacement == BEAD_WAVE_CHIRP || drive->force == BEAD_WAVE_CHIRP;
    if (chirp != bead_given(at, "to"))
        return BEAD_WRONG_KEY(reader, at, "to", "belongs to a chirp, which needs it");
    drive->to = chirp ? drive->to : 0;
    drive->bead = (double)drive->bead == last_bead ? last : drive->bead;
    if (drive->bead > last)
        return BEAD_WRONG_KEY(reader, at, "bead", "is %zu, but the last bead is %zu", drive->bead, last);
    if (!(bead_given(&map, "striker") && bead_given(&striker, "velocity")) && chain->start_count == 0)
        chain->striker_velocity = 0;
    return BEAD_OK;
}
