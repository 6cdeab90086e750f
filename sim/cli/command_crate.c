/* SPDX-License-Identifier: GPL-3.0-or-later */
/* --crate: the run, its time, its program and its files, in a form that archives read: RO-Crate 1.1, profile Process Run Crate. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "beadreel/api.h"
#include "beadreel/sink.h"
#include "sim/base/file.h"
#include "sim/base/json.h"
#include "sim/base/memory.h"
#include "sim/cli/command_line.h"
#include "sim/session/session_internal.h"

#define PROFILE "https://w3id.org/ro/wfrun/process/0.5"
static const char metadata[] = "ro-crate-metadata.json", scene_file[] = "ro-crate-scene.yaml";

/* https://www.iana.org/assignments/media-types */
static const char *const media_types[][2] = {{".png", "image/png"},
                                             {".apng", "image/apng"},
                                             {".svg", "image/svg+xml"},
                                             {".pdf", "application/pdf"},
                                             {".mp4", "video/mp4"},
                                             {".webm", "video/webm"},
                                             {".gif", "image/gif"},
                                             {".mkv", "video/matroska"},
                                             {".mov", "video/quicktime"},
                                             {".avif", "image/avif"},
                                             {".webp", "image/webp"},
                                             {".csv", "text/csv"},
                                             {".html", "text/html"},
                                             {".h5", "application/x-hdf5"},
                                             {".wav", "audio/vnd.wave"},
                                             {".yaml", "application/yaml"},
                                             {".eps", "application/postscript"},
                                             {".jpg", "image/jpeg"},
                                             {".tiff", "image/tiff"}};

struct crate {
    struct bead_json json;
    const struct bead_session *session;
    const struct command_program *program;
    char folder[PATH_MAX]; /* with a slash at the end; "": the working directory */
    char began[32], ended[32];
};

/* The place of a file in the crate, as part of a URI (RFC 3986); NULL: it is outside. To be freed. */
static char *place(const struct crate *crate, const char *path)
{
    const size_t length = strlen(crate->folder);
    if (strncmp(path, crate->folder, length) != 0 || path[length] == '/')
        return NULL;
    char *uri = NULL;
    size_t size;
    FILE *out = open_memstream(&uri, &size);
    for (const char *c = path + length; out && *c; c++) {
        const bool plain = memchr("-._~/", *c, 5) || (*c >= '0' && *c <= '9') || ((*c | 32) >= 'a' && (*c | 32) <= 'z');
        fprintf(out, plain ? "%c" : "%%%02X", (unsigned char)*c);
    }
    if (!out || fclose(out) == 0)
        return uri;
    free(uri);
    return NULL;
}

static void refer(struct bead_json *json, const char *key, const char *id)
{
    bead_json_open(json, key, '{');
    bead_json_text(json, "@id", id);
    bead_json_close(json, "}");
}

static void begin_entity(struct bead_json *json, const char *id, const char *type, const char *name)
{
    bead_json_open(json, NULL, '{');
    bead_json_text(json, "@id", id);
    bead_json_text(json, "@type", type);
    bead_json_text(json, "name", name);
}

static void refer_to_results(struct crate *crate)
{
    const struct bead_result *results = NULL;
    const size_t count = bead_session_results(crate->session, &results);
    for (size_t i = 0; i < count; i++) {
        BEAD_FREED char *id = place(crate, results[i].path);
        if (id)
            refer(&crate->json, NULL, id);
    }
}

static void write_file(struct bead_json *json, const char *id, const char *name, const char *about, double bytes)
{
    char size[32];
    const char *dot = strrchr(name, '.'), *type = NULL;
    for (size_t i = 0; dot && i < sizeof media_types / sizeof *media_types; i++)
        type = strcasecmp(dot, media_types[i][0]) == 0 ? media_types[i][1] : type;
    snprintf(size, sizeof size, "%.0f", bytes);
    begin_entity(json, id, "File", name);
    bead_json_text(json, "description", about);
    if (type)
        bead_json_text(json, "encodingFormat", type);
    bead_json_text(json, "contentSize", size);
    bead_json_close(json, "}");
}

static void write_files(struct crate *crate)
{
    const struct bead_result *results = NULL;
    const size_t count = bead_session_results(crate->session, &results);
    write_file(&crate->json, scene_file, scene_file, "the scene as it was run", (double)strlen(bead_session_text(crate->session)));
    for (size_t i = 0; i < count; i++) {
        BEAD_FREED char *id = place(crate, results[i].path);
        if (id)
            write_file(&crate->json, id, results[i].name, results[i].kind, (double)results[i].bytes);
    }
}

static void write_root(struct crate *crate)
{
    struct bead_json *json = &crate->json;
    begin_entity(json, metadata, "CreativeWork", "RO-Crate metadata");
    refer(json, "about", "./");
    refer(json, "conformsTo", "https://w3id.org/ro/crate/1.1");
    bead_json_close(json, "}");
    begin_entity(json, PROFILE, "CreativeWork", "Process Run Crate");
    bead_json_text(json, "version", "0.5");
    bead_json_close(json, "}");
    begin_entity(json, "./", "Dataset", "A run of beadreel");
    bead_json_text(json, "description", "A scene, and what beadreel " BEADREEL_VERSION " made of it");
    bead_json_text(json, "datePublished", crate->ended);
    bead_json_text(json, "license", "Not stated: whoever publishes it says how it may be used.");
    refer(json, "conformsTo", PROFILE);
    refer(json, "mentions", "#run");
    bead_json_open(json, "hasPart", '[');
    refer(json, NULL, scene_file);
    refer_to_results(crate);
    bead_json_close(json, "]}");
}

static void write_action(struct crate *crate)
{
    struct bead_json *json = &crate->json;
    begin_entity(json, "#program", "SoftwareApplication", crate->program->name);
    bead_json_text(json, "softwareVersion", BEADREEL_VERSION);
    bead_json_text(json, "license", "https://spdx.org/licenses/GPL-3.0-or-later");
    bead_json_close(json, "}");
    begin_entity(json, "#run", "CreateAction", "Run of the scene");
    refer(json, "instrument", "#program");
    bead_json_text(json, "startTime", crate->began);
    bead_json_text(json, "endTime", crate->ended);
    refer(json, "actionStatus", "http://schema.org/CompletedActionStatus");
    refer(json, "object", scene_file);
    bead_json_open(json, "result", '[');
    refer_to_results(crate);
    bead_json_close(json, "]}");
}

static enum bead_error fill_metadata(void *context, FILE *file, const char *, struct bead_message *)
{
    struct crate *crate = context;
    crate->json = (struct bead_json){.out = file, .lines = true};
    bead_json_open(&crate->json, NULL, '{');
    bead_json_text(&crate->json, "@context", "https://w3id.org/ro/crate/1.1/context");
    bead_json_open(&crate->json, "@graph", '[');
    write_root(crate);
    write_action(crate);
    write_files(crate);
    bead_json_close(&crate->json, "]}");
    fputc('\n', file);
    return BEAD_OK;
}

static enum bead_error fill_scene(void *context, FILE *file, const char *, struct bead_message *)
{
    const struct crate *crate = context;
    fputs(bead_session_text(crate->session), file);
    return BEAD_OK;
}

/* The directory of the one file that -o names, or else the directory -o: the path of an output without its name in the scene. */
static void find_folder(struct crate *crate, const char *output)
{
    struct bead_planned made = {.made = false};
    for (size_t i = 0; !made.made && bead_session_planned(crate->session, i, &made); i++) {
    }
    if (!made.made || !made.path)
        return;
    const char *path = made.path, *slash = strrchr(path, '/');
    const size_t length = strlen(path), name = strlen(made.name);
    const bool single = output && strcmp(output, path) == 0;
    const size_t folder = single ? (slash ? (size_t)(slash + 1 - path) : 0) : length - (name < length ? name : length);
    snprintf(crate->folder, sizeof crate->folder, "%.*s", (int)folder, path);
}

static void find_path(const struct crate *crate, const char *name, char path[PATH_MAX + 32])
{
    snprintf(path, PATH_MAX + 32, "%s%s", crate->folder, name);
}

enum bead_error command_crate_spare(const struct command *command, const struct bead_session *session, struct bead_message *msg)
{
    static const char *const names[] = {scene_file, metadata};
    struct crate crate = {.session = session};
    char path[PATH_MAX + 32];
    find_folder(&crate, command->job.output);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        find_path(&crate, names[i], path);
        BEAD_TRY(bead_session_spare_inputs(session, path, msg));
    }
    return BEAD_OK;
}

static enum bead_error write_one(struct crate *crate, const char *name, bead_file_fill fill, struct bead_message *msg)
{
    char path[PATH_MAX + 32];
    uint64_t bytes = 0;
    find_path(crate, name, path);
    return bead_file_write(path, fill, crate, &bytes, msg);
}

enum bead_error command_crate(const struct command *command, const struct bead_session *session, time_t began,
                              struct bead_message *msg)
{
    struct crate crate = {.session = session, .program = command->program};
    const time_t now = time(NULL);
    struct tm utc;
    strftime(crate.began, sizeof crate.began, "%FT%TZ", gmtime_r(&began, &utc));
    strftime(crate.ended, sizeof crate.ended, "%FT%TZ", gmtime_r(&now, &utc));
    find_folder(&crate, command->job.output);
    BEAD_TRY(write_one(&crate, scene_file, fill_scene, msg));
    return write_one(&crate, metadata, fill_metadata, msg);
}
