# SPDX-License-Identifier: GPL-3.0-or-later
# From what object files leave undefined (nm -u), the header through which they call a library that is opened late. The Makefile says
# which library, how its names begin (a regular expression), and the header that declares them. Variables are reached like functions.
$2 ~ "^" begin && !seen[$2]++ { name[++count] = $2 }

END {
    print "#include \"" header "\""
    print "struct bead_late {"
    for (i = 1; i <= count; i++) print "    __typeof__(&" name[i] ") " name[i] ";"
    print "};"
    print "#define BEAD_LATE \\"
    for (i = 1; i <= count; i++) print "    \"" name[i] "\\0\" \\"
    print ""
    for (i = 1; i <= count; i++) print "#define " name[i] " (*((const struct bead_late *)bead_" library ")->" name[i] ")"
}
