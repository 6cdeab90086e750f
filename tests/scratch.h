/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A directory for the files of a test program: made by its group's set-up, emptied and removed by its tear-down; after
 * support.h. */
#ifndef BEADREEL_TESTS_SCRATCH_H
#define BEADREEL_TESTS_SCRATCH_H

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static char directory[256];

static inline int make_directory(void **state)
{
    (void)state;
    snprintf(directory, sizeof directory, "%s/beadreel-XXXXXX", getenv("TMPDIR") ? getenv("TMPDIR") : "/tmp");
    return mkdtemp(directory) ? 0 : -1;
}

/* Remove a directory and all that is in it. */
static inline int remove_files(const char *path)
{
    char file[1024];
    DIR *dir = opendir(path);
    for (struct dirent *e; dir && (e = readdir(dir));) {
        snprintf(file, sizeof file, "%s/%s", path, e->d_name);
        if (e->d_name[0] != '.' && unlink(file) != 0)
            remove_files(file);
    }
    if (dir)
        closedir(dir);
    return rmdir(path);
}

static inline int remove_directory(void **state)
{
    (void)state;
    return remove_files(directory);
}

/* The scene `text` in a file of the directory, whose path is put into `path`. */
static inline void write_scene(const char *text, char path[512])
{
    snprintf(path, 512, "%s/scene.yaml", directory);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

#endif
