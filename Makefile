# SPDX-License-Identifier: GPL-3.0-or-later
# Beadreel: `make help` lists what there is.
PREFIX  ?= /usr/local
# Debian's own directory of libraries below /usr; elsewhere plain lib.
LIBDIR  ?= $(PREFIX)/lib$(if $(filter /usr,$(PREFIX)),$(addprefix /,$(shell $(CC) -print-multiarch 2>/dev/null)))
# Where Debian's python3 looks for modules.
PYTHONDIR ?= $(PREFIX)/lib/python3$(if $(filter /usr,$(PREFIX)),,$(shell python3 -c 'import sys; print(".%d" % sys.version_info[1])' 2>/dev/null))/dist-packages
ZSHDIR  ?= $(PREFIX)/share/zsh/site-functions
DESTDIR ?=
BUILD   ?= build
DEMO    ?= demo
# For a smaller film: --set KEY=VALUE
DEMO_SETTINGS ?=
THESIS  ?= thesis
CC      ?= cc
CFLAGS  ?= -O2 -g $(HARDENING)
LDFLAGS ?= -Wl,-z,relro,-z,now
# Developers and .ci/run: make WERROR=-Werror
WERROR  ?=
# Those of the drawing half, after CFLAGS.
RENDER_CFLAGS ?=
# Those of what takes the time of long runs, after these.
FAST    ?= -O3
VERSION := $(shell sed -n 's/^\#define BEADREEL_VERSION "\(.*\)"/\1/p' include/beadreel/api.h)
SOVERSION = 0
# Whose repository at GitHub this is; make metadata writes it where addresses are.
OWNER    = OWNER
SUITE   ?= bookworm
FUZZ_SECONDS ?= 30
FUZZ_RUNS ?= -1
FUZZ_SANITIZERS ?= address,undefined
KILLS   ?= 60
PAIRS   ?= 5
ALLOCATIONS ?= 60
CASES ?= 1000
MUTANTS ?= 100
SEED    ?= 1
ROOMS   ?= sim render
STRICT_LINK ?= -Wl,-z,defs

.DEFAULT_GOAL = all
# All cores, unless a number of jobs is given.
ifeq ($(MAKELEVEL)$(filter -j%,$(MAKEFLAGS)),0)
MAKEFLAGS += -j$(shell nproc 2>/dev/null || echo 2)
endif

# Debian packages (12 and 13): to build, to build and run the tests, and what .ci/run uses beyond those.
BUILD_DEPS = gcc libc6-dev pkg-config libhdf5-dev libyaml-dev libudunits2-dev librandom123-dev libpng-dev \
             libegl-dev libavformat-dev libavcodec-dev libavutil-dev libcairo2-dev libpango1.0-dev libfontconfig-dev fonts-stix fonts-lato
TEST_DEPS  = g++ libegl1 libegl-mesa0 libgl1-mesa-dri libcmocka-dev binutils hdf5-tools parallel poppler-utils ffmpeg python3-h5py python3-hypothesis man-db mandoc zsh fish
# Left out where a release has them no more: OSMesa went with Mesa 25.1.
WISHED_DEPS = libosmesa6
CI_DEPS    = ccache clang lld libclang-rt-dev clang-format cppcheck shellcheck mmdebstrap dpkg-dev debhelper dh-python lintian pandoc chromium \
             patchelf python3-pip python3-venv
# Programs of others that read trajectories; tests of what is missing are skipped and counted. Their readers in JavaScript come with npm.
READER_DEPS = octave gnuplot-nox python3-paraview python3-mdanalysis python3-xarray python3-h5netcdf python3-silx python3-nbconvert python3-ipykernel \
              python3-jsonschema python3-yaml \
              nodejs $(if $(shell command -v npm),,npm)
# The daemons of a cluster, for one test.
CLUSTER_DEPS = slurm-wlm munge
NPM_READERS = jsfive@0.4.2 h5wasm@0.10.3
# What `make peers` and `make stress` compare with: large, and left out where missing. H5Web comes with what it shows itself with;
# esbuild puts it together.
PEER_DEPS  = lammps python3-scipy
NPM_PEERS  = @h5web/app@16.0.1 @h5web/h5wasm@16.0.1 react@18.3.1 react-dom@18.3.1 esbuild@0.28.2
ARM64_DEPS = mmdebstrap gcc-aarch64-linux-gnu qemu-user-static

# Asked once, when a recipe first needs it: after `deps` has run in `make deps all`.
once              = $(eval $(1) := $(2))$($(1))
# Plain `hdf5` may be a build for MPI, where one is installed beside the serial one.
hdf5              = $(call once,hdf5,$(shell pkg-config --exists hdf5-serial 2>/dev/null && echo hdf5-serial || echo hdf5))
SIM_PACKAGES      = yaml-0.1 udunits
# Opened at run time where they are (beadreel --list libraries), linked by nothing; only their headers are needed.
OPENED_PACKAGES   = $(hdf5) egl libavformat libavcodec libavutil
RENDER_PACKAGES   = libpng cairo pangocairo fontconfig
sim_cflags        = $(call once,sim_cflags,$(shell pkg-config --cflags $(hdf5) $(SIM_PACKAGES)))
sim_libs          = $(call once,sim_libs,$(shell pkg-config --libs $(SIM_PACKAGES)) -lm -ldl -pthread)
# Tests look into trajectories.
hdf5_libs         = $(call once,hdf5_libs,$(shell pkg-config --libs $(hdf5)) -lhdf5_hl)
render_cflags     = $(call once,render_cflags,$(shell pkg-config --cflags $(RENDER_PACKAGES) $(OPENED_PACKAGES)))
render_libs       = $(call once,render_libs,$(shell pkg-config --libs $(RENDER_PACKAGES)) -ldl)
# Tests and benches read movies.
movie_libs        = $(call once,movie_libs,$(shell pkg-config --libs libavformat libavcodec libavutil))
test_libs         = $(call once,test_libs,$(shell pkg-config --libs cmocka))

# A fault in memory should end the program, not serve an attacker: checks of stacks and of copies; jumps land where they may.
HARDENING = -fstack-protector-strong -fstack-clash-protection -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3 \
            $(if $(x86),-fcf-protection,$(if $(arm64),-mbranch-protection=standard))
x86   = $(call once,x86,$(filter x86_64-%,$(machine)))
arm64 = $(call once,arm64,$(filter aarch64-%,$(machine)))
machine = $(call once,machine,$(shell $(CC) -dumpmachine))
# Same bits on every machine: no contraction, no fast-math; the same files in every directory.
WARN  = -Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla -Wpointer-arith -Wwrite-strings $(WERROR)
MODE  = -std=c2x -D_GNU_SOURCE -fPIC -fvisibility=hidden -ffp-contract=off -fno-math-errno -fno-trapping-math -pthread \
        "-ffile-prefix-map=$(CURDIR)=."
FLAGS = $(MODE) $(WARN) -Iinclude -I. $(CPPFLAGS) $(CFLAGS) -MMD -MP

# The two mains and what they share (command line) stay out of the libraries.
COMMAND_SOURCES = $(filter-out sim/cli/beadsim.c,$(wildcard sim/cli/*.c))
SIM_SOURCES     = $(filter-out sim/cli/%,$(wildcard sim/*/*.c))
RENDER_SOURCES  = $(filter-out render/beadreel.c,$(wildcard render/*.c render/*/*.c))
COMMAND_OBJECTS = $(COMMAND_SOURCES:%.c=$(BUILD)/%.o)
SIM_OBJECTS     = $(SIM_SOURCES:%.c=$(BUILD)/%.o)
RENDER_OBJECTS  = $(RENDER_SOURCES:%.c=$(BUILD)/%.o)
LIBRARIES       = $(BUILD)/libbeadsim.a $(BUILD)/libbeadreel.a $(BUILD)/libbeadsim.so $(BUILD)/libbeadreel.so
PROGRAMS        = $(BUILD)/beadsim $(BUILD)/beadreel

# Unit tests: every test_*.c in tests/ or a room of it is one cmocka program; other C files in tests/ are linked into all of them.
TEST_ROOMS   = tests/sim tests/render tests/film tests
TESTS        = $(patsubst %.c,$(BUILD)/tests/%,$(notdir $(wildcard $(TEST_ROOMS:=/test_*.c))))
TEST_SUPPORT = $(patsubst tests/%.c,$(BUILD)/tests/%.o,$(filter-out tests/test_%.c,$(wildcard tests/*.c)))
EXAMPLES     = $(patsubst tests/examples/%.c,$(BUILD)/tests/examples/%,$(wildcard tests/examples/*.c))
BENCHES      = $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/bench/*.c))
STRESSES     = $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/stress/*.c))
FAIL_ALLOC   = $(BUILD)/tests/fail_alloc.so
FUZZERS      = $(patsubst tests/fuzz/%.c,$(BUILD)/fuzz/%,$(wildcard tests/fuzz/fuzz_*.c))
FUZZ_SUPPORT = $(filter-out tests/fuzz/fuzz_%.c,$(wildcard tests/fuzz/*.c))
STATIC       = $(BUILD)/libbeadreel.a $(BUILD)/libbeadsim.a
FORMATTED    = $(wildcard include/beadreel/*.h sim/*/*.[ch] render/*.[ch] render/*/*.[ch] tests/*.[ch] tests/*/*.[ch])

# Debian's Python has Debian's packages.
python = $(firstword $(wildcard /usr/bin/python3) python3)

# `make V=1` shows the commands.
say = @$(if $(V),,printf '  %-5s %s\n' $(1) $(2);)
run = $(if $(V),set -x;)

all: $(PROGRAMS) $(LIBRARIES) ## both programs and both libraries, optimised (the default)

help: ## this list
	@echo "Targets (variables: PREFIX, DESTDIR, BUILD, CC, CFLAGS; V=1 shows the commands):"
	@sed -n 's/^\([a-z0-9-]*\):.*## \(.*\)/  \1|\2/p' $(firstword $(MAKEFILE_LIST)) | awk -F'|' '{printf "%-12s %s\n", $$1, $$2}'

# Install what is missing of the Debian packages $(1), and of $(2) what the release has: as root, with sudo, or say what to run.
define install_packages
	@absent() { \
	    for p; do case "$$(dpkg-query -W -f='$${Status}' "$$p" 2>/dev/null)" in *" ok installed") ;; *) printf ' %s' "$$p";; esac; done; \
	}; \
	known() { for p; do [ -z "$$(apt-cache madison "$$p" 2>/dev/null)" ] || printf ' %s' "$$p"; done; }; \
	missing=$$(absent $(1)); wished=$$(absent $(2)); \
	if [ -z "$$missing$$(known $$wished)" ]; then echo "All packages are there."; exit 0; fi; \
	if [ "$$(id -u)" = 0 ]; then as=; elif command -v sudo >/dev/null; then as=sudo; else as=none; fi; \
	if [ "$$as" != none ] && command -v apt-get >/dev/null; then \
	    apt="$$as env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300"; \
	    $$apt update -q && missing="$$missing$$(known $$wished)" && echo "Installing:$$missing" && \
	    $$apt install -q -y --no-install-recommends $$missing && exit 0; \
	fi; \
	echo >&2 "Packages are missing. As root, run:"; \
	echo >&2 "  apt-get update && apt-get install --no-install-recommends$$missing"; \
	exit 1
endef

# Without scripts of theirs.
define install_from_npm
	@command -v npm >/dev/null || exit 0; mkdir -p build/npm && cd build/npm && \
	    npm install --silent --no-audit --no-fund --ignore-scripts --legacy-peer-deps --prefix . $(1) || echo "npm could not install $(1)"
endef

deps: ## install the Debian packages needed to build, run and test (only what is missing)
	$(call install_packages,$(BUILD_DEPS) $(TEST_DEPS),$(WISHED_DEPS))
# apt-get locks: never two of them at a time.
deps-ci: | $(filter deps,$(MAKECMDGOALS)) ## the same for lint and .ci/run
	$(call install_packages,$(CI_DEPS))
	-$(call install_packages,,$(READER_DEPS) $(CLUSTER_DEPS))
	$(call install_from_npm,$(NPM_READERS))
deps-arm64: | $(filter deps deps-ci,$(MAKECMDGOALS)) ## the same for make arm64-test
	$(call install_packages,$(ARM64_DEPS))
deps-peers: | $(filter deps deps-ci,$(MAKECMDGOALS)) ## the same for peers and stress
	$(call install_packages,$(PEER_DEPS))
	$(call install_from_npm,$(NPM_PEERS))

# Where `deps` is asked for, everything waits for it; the first thing built checks that what it needs is there.
WAIT = $(filter deps deps-ci deps-peers deps-arm64,$(MAKECMDGOALS))
$(BUILD)/.ready: | $(WAIT)
	@mkdir -p $(@D)
	@pkg-config --version >/dev/null 2>&1 || { echo >&2 "pkg-config is missing: run 'make deps' first."; exit 1; }
	@missing=; for p in $(SIM_PACKAGES) $(RENDER_PACKAGES) $(OPENED_PACKAGES); do pkg-config --exists $$p || missing="$$missing $$p"; done; \
	echo '#include <Random123/philox.h>' | $(CC) -E - >/dev/null 2>&1 || missing="$$missing Random123"; \
	[ -z "$$missing" ] || { echo >&2 "Libraries are missing:$$missing. Run 'make deps' first."; exit 1; }
	@touch $@

# What most files include, for builds of clang with PRELUDE=1: it reads that once, which is half of the time that a file takes unoptimized.
# GCC's builds show what a file forgets to include. Where ccache keeps what is compiled, it needs the headers themselves.
PRELUDE_HEADERS = $(addsuffix .h,errno limits math pthread signal stdarg stdbool stddef stdint stdio stdlib string unistd sys/stat) \
                  $(patsubst include/%,%,$(wildcard include/beadreel/*.h)) sim/base/memory.h sim/base/file.h sim/chain/chain_internal.h
preluded = PRELUDE=$(if $(filter ccache,$(CC)),,1)
# One for each of the flags that clang wants to be the same: the level, whose last counts, and those of tests.
prelude_plain     = -O0
prelude_optimized = -O1
prelude_tests     = $(unoptimized) -Wno-write-strings
preludes = $(if $(PRELUDE),$(patsubst %,$(BUILD)/prelude/%.pch,plain optimized tests))
$(BUILD)/prelude/%.pch: $(BUILD)/.ready
	@mkdir -p $(@D)
	$(call say,CC,$@) $(run) printf '#include <%s>\n' $(PRELUDE_HEADERS) | \
	    $(CC) $(FLAGS) $(sim_cflags) $(render_cflags) $(prelude_$*) -MF $(@:.pch=.d) -MT $@ -x c-header - -o $@
prelude = $(if $(PRELUDE),-include-pch $(BUILD)/prelude/$(1).pch)
# Of a file with the flags $(1). Other instruction sets would need one of their own.
prelude_by_level = $(if $(filter -m%,$(1)),,$(call prelude,$(if $(filter -O0,$(lastword $(filter -O%,$(1)))),plain,optimized)))

$(BUILD)/sim/%.o: sim/%.c $(BUILD)/.ready | $(WAIT) $(preludes)
	@mkdir -p $(@D)
	$(call say,CC,$<) $(run) $(CC) $(FLAGS) $(sim_cflags) $(extra_$(*F)) $(call prelude_by_level,$(CFLAGS) $(extra_$(*F))) $(late) -c $< -o $@
$(BUILD)/render/%.o: render/%.c $(BUILD)/.ready | $(WAIT) $(preludes)
	@mkdir -p $(@D)
	$(call say,CC,$<) $(run) $(CC) $(FLAGS) $(RENDER_CFLAGS) $(sim_cflags) $(render_cflags) $(extra_$(*F)) \
	    $(call prelude_by_level,$(CFLAGS) $(RENDER_CFLAGS) $(extra_$(*F))) $(late) -c $< -o $@

# One source of the kernels of forces and of pixels, compiled for each instruction set and chosen at run time.
# Those of x86-64 are empty elsewhere.
extra_kernels_portable = $(FAST)
extra_kernels_sse2     = $(if $(x86),$(FAST) -msse2)
extra_kernels_avx2     = $(if $(x86),$(FAST) -mavx2)
extra_kernels_avx512   = $(if $(x86),$(FAST) -mavx512f -mavx512dq -mavx512vl -mprefer-vector-width=512)
# Loops over all samples and pixels.
extra_trajectory_read = $(FAST)
extra_heights = $(FAST)
extra_fourier = $(FAST)
extra_etd = $(FAST)
extra_kdv_solver = $(FAST)
extra_fput_string = $(FAST)
extra_shock_law = $(FAST)
extra_area_kernels = $(FAST)
extra_area_colours = $(FAST)
extra_colour_table = $(FAST)

extra_pixel_kernels_portable = $(FAST)
extra_pixel_kernels_sse2     = $(if $(x86),$(FAST) -msse2)
extra_pixel_kernels_avx2     = $(if $(x86),$(FAST) -mavx2)
extra_pixel_kernels_avx512   = $(if $(x86),$(FAST) -mavx512f -mavx512bw -mavx512dq -mavx512vl -mprefer-vector-width=512)

# The names that the loader knows HDF5's two libraries by are those that a program linked to them would need.
hdf5_files = $(call once,hdf5_files,$(shell mkdir -p $(BUILD) && $(CC) -shared -x c /dev/null -o $(BUILD)/.hdf5.so $(LDFLAGS) -Wl,--no-as-needed $(hdf5_libs) && \
               readelf -d $(BUILD)/.hdf5.so | sed -n 's/.*NEEDED.*\[\(libhdf5.*\)\]/\1/p'))
hdf5_hl    = $(firstword $(foreach f,$(hdf5_files),$(if $(findstring _hl,$f),$f)))
hdf5_core  = $(firstword $(filter-out $(hdf5_hl),$(hdf5_files)))
hdf5_packages = $(call once,hdf5_packages,$(shell dpkg-query -S $(hdf5_files:%=*/%) 2>/dev/null | sed 's/:.*//' | sort -u | paste -sd, | sed 's/,/ and /'))
extra_h5_library = -DBEAD_HDF5_LIBRARY='"$(hdf5_core)"' -DBEAD_HDF5_HL_LIBRARY='"$(hdf5_hl)"' -DBEAD_HDF5_PACKAGES='"$(or $(hdf5_packages),HDF5)"'

# A library that is opened late (sim/base/library.h): $(1), whose names begin with $(2) and are declared by the header $(3), is
# called by the sources $(4). Compiled without build/late/$(1).h they leave undefined what they need of it; with it they call that
# through the table bead_$(1).
define opened_late
$(BUILD)/late/$(1).h: $(4) $(wildcard $(3)) sim/base/late.awk $(BUILD)/.ready | $(WAIT)
	@mkdir -p $$(@D)
	$$(call say,NAMES,$(1)) $$(run) for source in $(4); do \
	    $$(CC) $$(MODE) -fno-lto -Iinclude -I. $$(CPPFLAGS) $$(CFLAGS) $$(sim_cflags) $$(render_cflags) $$(extra_h5_library) -DBEAD_LATE='""' \
	        -c $$$$source -o $$@.o && nm -u $$@.o || exit 1; done >$$@.undefined
	@awk -v library='$(1)' -v begin='$(2)' -v header='$(3)' -f sim/base/late.awk $$@.undefined >$$@ && rm $$@.*
$(4:%.c=$(BUILD)/%.o): $(BUILD)/late/$(1).h
$(4:%.c=$(BUILD)/%.o): private late = -include $(BUILD)/late/$(1).h
endef
$(eval $(call opened_late,hdf5,H5,sim/hdf5/h5_private.h,$(wildcard sim/hdf5/h5*.c)))
$(eval $(call opened_late,libav,av,render/encode/libav.h,$(wildcard render/encode/*.c)))
$(eval $(call opened_late,gl,gl[A-Z],render/paint/gl.h,render/paint/gl.c render/paint/paint_gl.c render/paint/stage_gl.c))
$(eval $(call opened_late,egl,egl,EGL/egl.h,render/paint/gl_egl.c))
$(eval $(call opened_late,osmesa,OSMesa,render/paint/gl_osmesa.h,render/paint/gl_osmesa.c))

# The only place that knows where things get installed; compiled again when that changes.
extra_assets = -DBEAD_DATADIR='"$(PREFIX)/share/beadreel"'
$(BUILD)/sim/base/assets.o: $(BUILD)/.prefix
$(BUILD)/.prefix: always
	@mkdir -p $(@D)
	@echo '$(PREFIX)' | cmp -s - $@ || echo '$(PREFIX)' > $@

$(BUILD)/libbeadsim.a: $(SIM_OBJECTS)
	$(call say,AR,$@) rm -f $@ && ar rcs $@ $^
$(BUILD)/libbeadreel.a: $(RENDER_OBJECTS)
	$(call say,AR,$@) rm -f $@ && ar rcs $@ $^
$(BUILD)/libbeadsim.so: $(SIM_OBJECTS)
	$(call say,LD,$@) $(run) $(CC) -shared -Wl,-soname,$(@F).$(SOVERSION) $(STRICT_LINK) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(sim_libs)
	@ln -sf $(@F) $@.$(SOVERSION)
$(BUILD)/libbeadreel.so: $(RENDER_OBJECTS) $(BUILD)/libbeadsim.so
	$(call say,LD,$@) $(run) $(CC) -shared -Wl,-soname,$(@F).$(SOVERSION) $(STRICT_LINK) $(CFLAGS) $(LDFLAGS) -o $@ $(RENDER_OBJECTS) \
	    -L$(BUILD) -lbeadsim $(render_libs) $(sim_libs)
	@ln -sf $(@F) $@.$(SOVERSION)
$(BUILD)/beadsim: $(BUILD)/sim/cli/beadsim.o $(COMMAND_OBJECTS) $(BUILD)/libbeadsim.a
	$(call say,LD,$@) $(run) $(CC) -pie $(CFLAGS) $(LDFLAGS) -o $@ $^ $(sim_libs)
$(BUILD)/beadreel: $(BUILD)/render/beadreel.o $(COMMAND_OBJECTS) $(BUILD)/libbeadreel.a $(BUILD)/libbeadsim.a
	$(call say,LD,$@) $(run) $(CC) -pie $(CFLAGS) $(LDFLAGS) -o $@ $^ $(sim_libs) $(render_libs)

demo: $(BUILD)/beadreel ## a clean beside a delocalised wave: movie, pictures, data into demo/
	BEADREEL_ASSETS=assets $(BUILD)/beadreel clean-vs-delocalised -o $(DEMO) $(DEMO_SETTINGS)

thesis: $(BUILD)/beadreel ## the figures of the thesis, with their numbers, into thesis/
	@set -e; for f in $(sort $(wildcard assets/scenes/thesis/*.yaml)); do \
	    BEADREEL_ASSETS=assets $(BUILD)/beadreel thesis/$$(basename $$f .yaml) -o $(THESIS); done

gallery: $(BUILD)/beadreel ## the README's pictures, from ready scenes, into assets/gallery/
	BEADREEL_ASSETS=assets assets/gallery/make.sh $(BUILD)/beadreel assets/gallery

findings: $(BUILD)/beadsim ## claims of the thesis beside what comes out, from runs of minutes: assets/findings.md
	@assets/findings/make.py --renew $< >$(BUILD)/findings.md && mv $(BUILD)/findings.md assets/findings.md

# Each test program has the libraries in it: a linker that is several times as fast, where there is one (the plugin of -flto is GNU's).
fast_linker = $(if $(findstring -flto,$(CFLAGS)),,$(call once,fast_linker_found,$(firstword $(foreach l,lld gold,$(if $(shell command -v ld.$(l)),-fuse-ld=$(l))))))
# Tests fill structures that own their strings with literals.
compile_test = $(CC) $(FLAGS) -Wno-write-strings -Itests $(sim_cflags) $(render_cflags)
# What tests themselves compute takes no time beside what they ask of the libraries; optimizing them takes longer than running them.
unoptimized = -O0 -U_FORTIFY_SOURCE
$(TEST_SUPPORT): $(BUILD)/tests/%.o: tests/%.c $(BUILD)/.ready | $(WAIT) $(preludes)
	@mkdir -p $(@D)
	$(call say,CC,$<) $(run) $(compile_test) $(unoptimized) $(call prelude,tests) -c $< -o $@
# Tests whose allocations fail have an allocator of their own.
with_test_allocations = tests/torture/fail_alloc.c -fno-builtin
with_test_drawn_allocations = $(with_test_allocations)
with_test_markup = tests/torture/fail_alloc.c -fno-builtin
# Its locks fail where it says so, and what it waits for happens meanwhile.
with_test_files = -Wl,--wrap=flock -Wl,--wrap=nanosleep
# Of the command line, which is in no library, by a clock and a terminal that it sets.
with_test_progress = $(BUILD)/sim/cli/command_progress.o -Wl,--wrap=clock_gettime -Wl,--wrap=isatty
$(BUILD)/tests/test_progress: $(BUILD)/sim/cli/command_progress.o
# Functions of libraries fail where they say so.
with_test_failing_codecs = -Wl,--wrap=bead_library_load
with_test_gl_failures = -Wl,--wrap=bead_gl_load
# It looks at the layouts of all figures.
with_test_ready_figures = -Wl,--wrap=graph_layout_make
# By room: make would look a name up where an old build knew it. Compiled by itself, for ccache.
define test_room
$(patsubst $(1)/%.c,$(BUILD)/tests/%.o,$(wildcard $(1)/test_*.c)): $(BUILD)/tests/%.o: $(1)/%.c $(BUILD)/.ready | $(WAIT) $(preludes)
	@mkdir -p $$(@D)
	$$(call say,CC,$$<) $$(run) $$(compile_test) $$(unoptimized) $$(or $$(filter -f%,$$(with_$$(*F))),$$(call prelude,tests)) -c $$< -o $$@
endef
$(foreach room,$(TEST_ROOMS),$(eval $(call test_room,$(room))))
$(TESTS): $(BUILD)/tests/%: $(BUILD)/tests/%.o $(TEST_SUPPORT) $(STATIC)
	$(call say,TEST,$@) $(run) $(compile_test) $(fast_linker) -MF $@.link.d -MT $@ -o $@ $< $(with_$(@F)) $(TEST_SUPPORT) $(STATIC) $(render_libs) \
	    $(sim_libs) $(hdf5_libs) $(movie_libs) $(test_libs)
# As a user's program: public headers and shared libraries only.
example_film = -lbeadreel $(shell pkg-config --cflags --libs cairo)
$(EXAMPLES): $(BUILD)/tests/examples/%: tests/examples/%.c $(LIBRARIES)
	@mkdir -p $(@D)
	$(call say,TEST,$<) $(run) $(CC) -std=c17 $(WARN) -Iinclude $(CFLAGS) -MMD -MP -MF $@.d -MT $@ -o $@ $< -L$(BUILD) \
	    $(example_$(@F)) -lbeadsim -lm -Wl,-rpath,$(abspath $(BUILD))
# Measured beside this program where they are installed.
peer_precision_gsl      = $(if $(wildcard /usr/include/gsl/gsl_odeiv2.h),-DBENCH_GSL -lgsl -lgslcblas)
peer_precision_sundials = $(if $(wildcard /usr/include/arkode/arkode_erkstep.h),-DBENCH_SUNDIALS -lsundials_cvode -lsundials_arkode \
                          -lsundials_nvecserial -lsundials_sunnonlinsolfixedpoint)
$(BENCHES) $(STRESSES): $(BUILD)/tests/%: tests/%.c $(STATIC)
	@mkdir -p $(@D)
	$(call say,TEST,$<) $(run) $(compile_test) $(fast_linker) -MF $@.d -MT $@ -o $@ $< $(STATIC) $(render_libs) $(sim_libs) $(movie_libs) $(peer_$(@F))

test: all $(TESTS) $(EXAMPLES) $(FAIL_ALLOC) ## the tests of three minutes: all except those that tests/slow.txt names; ends with `N passed, M failed`
	@PART=quick tests/run.sh $(BUILD)

test-slow: all $(TESTS) $(EXAMPLES) $(FAIL_ALLOC) ## the tests that tests/slow.txt names
	@PART=slow tests/run.sh $(BUILD)

check: all $(TESTS) $(EXAMPLES) $(FAIL_ALLOC) ## all tests: those of `make test` and `make test-slow`
	@tests/run.sh $(BUILD)

compile: all $(TESTS:=.o) $(EXAMPLES) $(BENCHES) $(STRESSES) $(FAIL_ALLOC) ## everything, tests and benchmarks too, without running it or linking the tests

fresh: ## README's commands on a bare Debian: make fresh SUITE=bookworm|trixie (root, mmdebstrap; minutes)
	@tests/fresh.sh $(SUITE)

release-check: ## what stands between this commit and the release TAG=vVERSION
	@.github/release-check.sh "$(TAG)" "$(VERSION)"
deb: ## the Debian packages of the last commit, into build/deb (make deps deps-ci)
	@rm -rf $(BUILD)/deb && mkdir -p $(BUILD)/deb && git clone -q . $(BUILD)/deb/beadreel
	@cd $(BUILD)/deb/beadreel && env -u MAKEFLAGS -u MAKELEVEL -u MFLAGS -u BUILD dpkg-buildpackage -us -uc -J$$(nproc) \
	    $(DPKG_DEB_COMPRESSOR_LEVEL:%=--source-option=-z%)
	@rm -rf $(BUILD)/deb/beadreel && ls $(BUILD)/deb/*.deb
# Of the host's release, or SUITE's, built there.
asked_suite = $(if $(findstring command line,$(origin SUITE)),$(SUITE))
deb-test: $(if $(asked_suite),,deb) ## these packages pass lintian, install on a bare Debian and work there; SUITE=trixie (root, mmdebstrap; minutes)
	@mkdir -p $(BUILD)/deb && tests/packages.sh $(BUILD)/deb $(asked_suite)

wheel: all ## the programs and the Python module for pip, into build/wheel (python3-pip, patchelf)
	@rm -rf $(BUILD)/wheel && BUILD=$(BUILD) $(python) -m pip wheel -q --no-index --no-deps --wheel-dir $(BUILD)/wheel . && ls $(BUILD)/wheel/*.whl

archive = beadreel-$(VERSION)
# What runs wherever it is unpacked.
bundle = $(archive)-$(shell uname -m)-linux
tarball: all ## programs with all they need, to unpack anywhere, and what is in it (SPDX): build/beadreel-VERSION-MACHINE-linux.tar.gz (patchelf)
	@assets/package/tarball.sh $(BUILD) $(bundle)
image: tarball ## an image for containers (OCI), of the tarball and Debian's C library: build/image (root, mmdebstrap, umoci)
	@assets/package/image.sh $(BUILD)/$(bundle).tar.gz $(BUILD)/image $(VERSION)
bare-test: image ## the demo from the image, and from the tarball on bare Debian 12, 13 and Ubuntu 24.04 (root, mmdebstrap; by hand, minutes)
	@tests/bare.sh image $(BUILD)/image $(VERSION)
	@for suite in bookworm trixie noble; do tests/bare.sh tarball $(BUILD)/$(bundle).tar.gz $$suite || exit 1; done

twice: ## the programs and libraries, built in two directories: same bytes? (by hand; two builds)
	@rm -rf $(BUILD)/twice && tests/twice.sh $(BUILD)/twice $(notdir $(PROGRAMS) $(LIBRARIES))

arm64-test: | $(WAIT) ## all results on arm64, in QEMU, have the bits of x86-64 (root, mmdebstrap; make deps-arm64; 8 minutes of CPU)
	@tests/arm64.sh $(filter-out gcc pkg-config,$(BUILD_DEPS))

metadata: ## the owner (OWNER above), the version and the citation in all files that repeat them: codemeta.json, .zenodo.json, debian/ (python3-yaml)
	@$(python) assets/package/metadata.py $(OWNER)

golden: all $(BUILD)/tests/test_golden ## make the golden pictures of the tests anew; look at them before you commit
	@BEADREEL_ASSETS=assets BUILD=$(BUILD) BEADREEL_GOLDEN=update $(BUILD)/tests/test_golden

symbols: $(LIBRARIES) ## list what the libraries export, after a function has come: tests/reference/*.symbols
	@tests/symbols.sh $(BUILD)

asan: ## all tests under address and undefined-behaviour sanitizers
	@$(MAKE) --no-print-directory BUILD=$(BUILD)-asan STRICT_LINK= \
	    CFLAGS="-O1 -g -fno-omit-frame-pointer -fsanitize=address,undefined -fno-sanitize-recover=all" test

coverage: ## lines and branches of sim and render that the tests reach, by room (gcc; half an hour)
	@$(MAKE) --no-print-directory BUILD=$(BUILD)-coverage WERROR= CFLAGS="-O0 -g --coverage -fprofile-update=atomic" counted
	@tests/coverage.sh $(BUILD)-coverage
# PART=short: without the tests that tests/long.txt names.
counted_tests = $(if $(filter short,$(PART)),$(filter-out $(patsubst %,$(BUILD)/tests/%,$(shell sed 's/ .*//' tests/long.txt)),$(TESTS)),$(TESTS))
counted: all $(counted_tests) $(EXAMPLES) $(FAIL_ALLOC)
# The compiler's warnings of what `counted` leaves out, with nothing made of it.
left_out = $(wildcard $(foreach t,$(notdir $(filter-out $(counted_tests),$(TESTS))),$(TEST_ROOMS:=/$t.c)) tests/bench/*.c tests/stress/*.c)
looked_through: $(BUILD)/.ready $(preludes)
	$(call say,LOOK,"$(words $(left_out)) others") $(run) printf '%s\0' $(left_out) | \
	    xargs -0 -n 1 -P $$(nproc) $(filter-out -MMD -MP,$(compile_test)) $(unoptimized) $(call prelude,tests) -fsyntax-only

properties: all ## properties of every scene, CASES=1000 random scenes each (by hand; a quarter of an hour)
	@$(python) -B tests/properties.py $(BUILD)/beadsim $(CASES)

mutants: ## small faults in sim and render that no test notices: MUTANTS=100 SEED=1 ROOMS="sim render" (by hand; 5 s a fault, and 20 minutes first)
	@tests/mutants.py --count $(MUTANTS) --seed $(SEED) --work $(BUILD)-mutants -- $(ROOMS)

tsan: ## demo, sweep and every kind of output under the thread sanitizer; ends with `N passed, M failed`
	@$(MAKE) --no-print-directory BUILD=$(BUILD)-tsan $(if $(findstring clang,$(CC)),$(preluded)) STRICT_LINK= FAST=-O1 $(unoptimized_too:%=extra_%=-O0) CFLAGS="-O0 -g1 -fno-omit-frame-pointer -fsanitize=thread" all
	@tests/tsan.sh $(BUILD)-tsan

$(FAIL_ALLOC): tests/torture/fail_alloc.c
	@mkdir -p $(@D)
	$(call say,TEST,$<) $(run) $(CC) -std=c2x -D_GNU_SOURCE -O1 -g -fPIC -fno-builtin $(WARN) -shared -o $@ $<
torture: all $(FAIL_ALLOC) ## kills, full disks, signals, failing allocations; KILLS=60, PAIRS=5, ALLOCATIONS=60 or all, PARTS=...; ends with `N passed, M failed`
	@tests/torture/torture.sh $(BUILD) $(KILLS) $(ALLOCATIONS) $(PAIRS) $(PARTS)

# One build for libFuzzer's targets and for tests under sanitizers: clang's, in all of the project's code. Comparisons of numbers are not
# traced, which would halve the speed; those of texts are. Undefined behaviour is a trap: the report has where it is, but not what, whose
# words take a quarter of the compiler's time. Null pointers end the program anyhow, and what lies askew is read as well on x86-64 and
# arm64: to look for both takes another sixth. `make asan` has it all. What draws is not optimized, nor are kernels that only tests choose
# here, nor transforms: to optimize them takes longer than they run.
unoptimized_too = fourier kernels_portable kernels_sse2 pixel_kernels_portable pixel_kernels_sse2
any_clang = $(if $(findstring clang,$(CC)),$(CC),clang)
sanitized_build = --no-print-directory RENDER_CFLAGS=-O0 FAST=-O1 $(unoptimized_too:%=extra_%=-O0) BUILD=$(BUILD)-fuzz CC="$(any_clang)" $(preluded) STRICT_LINK= \
    CFLAGS="-O1 -gline-tables-only -fno-omit-frame-pointer -fsanitize=fuzzer-no-link,$(FUZZ_SANITIZERS) -fno-sanitize=null,alignment -fsanitize-trap=undefined -fno-sanitize-coverage=trace-cmp"
sanitized: ## clang builds what fuzz and asan-short run, and looks through the other tests and benchmarks
	@$(MAKE) $(sanitized_build) PART=short counted looked_through fuzzers
asan-short: ## the tests of minutes under sanitizers: all but those that tests/long.txt names
	@$(MAKE) $(sanitized_build) PART=short counted
	@PART=short tests/run.sh $(BUILD)-fuzz

# Each target for FUZZ_SECONDS, or FUZZ_RUNS where that is shorter.
$(FUZZERS): $(BUILD)/fuzz/%: tests/fuzz/%.c $(FUZZ_SUPPORT) tests/fuzz/fuzz.h $(COMMAND_OBJECTS) $(STATIC)
	@mkdir -p $(@D)
	$(call say,FUZZ,$<) $(run) $(filter-out -MMD -MP,$(compile_test)) $(fast_linker) -fsanitize=fuzzer -o $@ $< $(FUZZ_SUPPORT) $(COMMAND_OBJECTS) $(STATIC) $(render_libs) $(sim_libs) $(hdf5_libs)
fuzzers: $(BUILD)/beadsim $(FUZZERS)
fuzz: ## random scenes, settings, command lines and files, FUZZ_SECONDS each; ends with `N passed, M failed`
	@$(MAKE) $(sanitized_build) fuzzers
	@tests/fuzz/run.sh $(BUILD)-fuzz $(FUZZ_SECONDS) $(FUZZ_RUNS) $(TARGETS)

campaign: ## all of that at full length, an hour or two, and its figures: tests/stress/RESULTS.md
	@tests/campaign.sh $(BUILD)

# The programs and scripts of a folder of tests, one after the other; a script x.sh itself runs the programs x_*.
scripts  = $(wildcard tests/$(1)/*.sh)
alone    = $(filter-out $(addprefix $(BUILD)/,$(addsuffix _%,$(basename $(scripts)))),$(2))
run_each = @set -e; for b in $(alone) $(scripts); do echo "== $$b"; BEADREEL_ASSETS=assets $$b $(BUILD); done

bench: all $(BENCHES) ## measure: every program and script of tests/bench
	$(call run_each,bench,$(BENCHES))
stress: all $(STRESSES) ## extreme chains: every program and script of tests/stress
	$(call run_each,stress,$(STRESSES))
peers: $(BUILD)/beadsim ## beside exact results, SciPy and LAMMPS, where they are installed: tests/peers/RESULTS.md (a minute)
	@$(python) tests/peers/peers.py $<

lint: ## formatting, static analysis
	@echo "clang-format" && clang-format --dry-run -Werror $(FORMATTED)
	@echo "cppcheck" && cppcheck --quiet --std=c11 --language=c --error-exitcode=1 --inline-suppr --enable=warning,performance,portability \
	    --suppressions-list=tests/cppcheck.txt -j $$(nproc) -Iinclude -I. -D__linux__ -D__x86_64__ -DBEAD_DATADIR='""' \
	    -DBEAD_HDF5_LIBRARY='""' -DBEAD_HDF5_HL_LIBRARY='""' -DBEAD_HDF5_PACKAGES='""' -DBEAD_LATE='""' sim render
	@echo "shellcheck" && shellcheck -S warning -e SC2034,SC2154 $(wildcard .ci/run .github/*.sh assets/*/*.sh assets/completions/*.bash tests/*.sh tests/*/*.sh tests/*.bash)

MANUALS = $(wildcard assets/man/*.[15])
man: $(PROGRAMS) ## write options, keys and lists into the man pages again, and the schema of scenes
	@$(BUILD)/beadreel --list schema >$(BUILD)/scene.schema.json && mv $(BUILD)/scene.schema.json assets/scene.schema.json
	@BEADREEL_ASSETS=assets assets/man/make.sh $(BUILD) $(MANUALS)
doc: $(BUILD)/beadreel ## the manual and the man pages as HTML with two live reports, into build/doc (pandoc, mandoc)
	@rm -rf $(BUILD)/doc && assets/manual/make.py html $(BUILD) $(BUILD)/doc
	@ls $(BUILD)/doc/*.html

ASSETS = $(shell cd assets && find . -type f ! -name '*.png' ! -path './man/*' ! -path './completions/*' ! -path './gallery/*' ! -path './findings/*' ! -path './python/*' ! -path './manual/*' ! -path './package/*' | sed 's,^\./,,')
SHARE  = $(DESTDIR)$(PREFIX)/share

# Everything at its place below DESTDIR, an empty directory.
staged:
	install -d $(DESTDIR)$(PREFIX)/bin $(DESTDIR)$(LIBDIR)/pkgconfig $(DESTDIR)$(PREFIX)/include/beadreel
	install -d $(SHARE)/man/man1 $(SHARE)/man/man5
	install -m 755 $(PROGRAMS) $(DESTDIR)$(PREFIX)/bin
	install -m 644 include/beadreel/*.h $(DESTDIR)$(PREFIX)/include/beadreel
	for l in beadsim beadreel; do \
	    install -m 644 $(BUILD)/lib$$l.a $(DESTDIR)$(LIBDIR) && \
	    install -m 755 $(BUILD)/lib$$l.so $(DESTDIR)$(LIBDIR)/lib$$l.so.$(VERSION) && \
	    ln -sf lib$$l.so.$(VERSION) $(DESTDIR)$(LIBDIR)/lib$$l.so.$(SOVERSION) && \
	    ln -sf lib$$l.so.$(SOVERSION) $(DESTDIR)$(LIBDIR)/lib$$l.so || exit 1; \
	done
	printf '%s\n' 'prefix=$(PREFIX)' 'libdir=$(LIBDIR)' 'includedir=$${prefix}/include' '' 'Name: beadsim' \
	    'Description: Waves in chains of beads: simulation' 'Version: $(VERSION)' 'Requires.private: $(SIM_PACKAGES)' \
	    'Libs: -L$${libdir} -lbeadsim' 'Libs.private: -lm -ldl -pthread' 'Cflags: -I$${includedir}' \
	    > $(DESTDIR)$(LIBDIR)/pkgconfig/beadsim.pc
	printf '%s\n' 'prefix=$(PREFIX)' 'libdir=$(LIBDIR)' 'includedir=$${prefix}/include' '' 'Name: beadreel' \
	    'Description: Waves in chains of beads: pictures and movies' 'Version: $(VERSION)' 'Requires: beadsim cairo' \
	    'Requires.private: $(RENDER_PACKAGES)' 'Libs: -L$${libdir} -lbeadreel' 'Libs.private: -ldl' 'Cflags: -I$${includedir}' \
	    > $(DESTDIR)$(LIBDIR)/pkgconfig/beadreel.pc
	install -d $(SHARE)/beadreel && umask 022 && cd assets && cp --parents --no-preserve=mode $(ASSETS) $(SHARE)/beadreel
	for m in $(MANUALS); do install -m 644 $$m $(SHARE)/man/man$${m##*.} || exit 1; done
	install -d $(SHARE)/bash-completion/completions $(DESTDIR)$(ZSHDIR) $(SHARE)/fish/vendor_completions.d
	install -m 644 assets/completions/beadreel.bash $(SHARE)/bash-completion/completions/beadreel
	ln -sf beadreel $(SHARE)/bash-completion/completions/beadsim
	install -m 644 assets/completions/_beadreel $(DESTDIR)$(ZSHDIR)
	install -m 644 assets/completions/beadreel.fish $(SHARE)/fish/vendor_completions.d
	ln -sf beadreel.fish $(SHARE)/fish/vendor_completions.d/beadsim.fish
	for m in $(wildcard assets/python/beadreel/*.py assets/python/beadreel/py.typed); do install -D -m 644 $$m $(DESTDIR)$(PYTHONDIR)/$${m#assets/python/} || exit 1; done

# What came, and which directories were new: `uninstall` removes just these.
INSTALLED = $(PREFIX)/share/beadreel/installed
install: all ## install to PREFIX (default /usr/local), libraries to LIBDIR, below DESTDIR
	@case "$(PREFIX)" in /*) ;; *) echo >&2 "PREFIX must begin with /; DESTDIR need not."; exit 1 ;; esac
	@set -e; stage=$$(mktemp -d); trap 'rm -rf "$$stage"' EXIT; mkdir -p "$(DESTDIR)/"; to=$$(cd "$(DESTDIR)/" && pwd -P); \
	$(MAKE) -s staged DESTDIR="$$stage" && cd "$$stage" && touch ".$(INSTALLED)"; \
	{ cat "$$to$(INSTALLED)" 2>/dev/null || true; \
	  find . -mindepth 1 ! -type d -printf '%P\n' -o -type d -printf '%P/\n' | while read -r n; do case $$n in \
	      /) ;; */) [ -d "$$to/$$n" ] || echo "$$n" ;; *) echo "$$n" ;; esac; done; } | LC_ALL=C sort -u >"$$stage.list"; \
	mv "$$stage.list" ".$(INSTALLED)"; \
	tar -cf - . | tar -xf - -C "$$to/" --no-same-owner --no-overwrite-dir --keep-directory-symlink
	@echo "Installed below $(DESTDIR)$(PREFIX)."
	@$(if $(DESTDIR),,echo "Programs find the shared libraries in $(LIBDIR) once ldconfig has run (as root), or with LD_LIBRARY_PATH=$(LIBDIR).")

uninstall: ## remove what `make install` put there, and the directories that it made
	@cd "$(DESTDIR)/" && list=$$(LC_ALL=C sort -r ".$(INSTALLED)" 2>/dev/null) || { echo "Nothing is installed below $(DESTDIR)$(PREFIX)."; exit 0; }; \
	echo "$$list" | while read -r n; do case $$n in \
	    */) rmdir --ignore-fail-on-non-empty "$$n" || true ;; \
	    *.py) c=$${n%/*}/__pycache__ m=$${n##*/}; rm -f "$$n" "$$c/$${m%py}"*.pyc; rmdir --ignore-fail-on-non-empty "$$c" 2>/dev/null || true ;; \
	    *) rm -f "$$n" ;; esac; done

# The time of the last commit, for what must say when it was made.
epoch = $(shell git log -1 --format=%ct)
dist: ## the sources of the last commit, the same bytes each time: build/beadreel-VERSION.tar.gz, what is in it (SPDX), SHA256SUMS
	@mkdir -p $(BUILD)
	@git archive --prefix=$(archive)/ -o $(BUILD)/$(archive).tar HEAD
	@gzip -9nf $(BUILD)/$(archive).tar
	@SOURCE_DATE_EPOCH=$(epoch) $(python) assets/package/sbom.py $(BUILD)/$(archive).tar.gz $(BUILD_DEPS) >$(BUILD)/$(archive).spdx.json
	@cd $(BUILD) && sha256sum $(archive).tar.gz $(archive).spdx.json >SHA256SUMS && printf '$(BUILD)/%s\n' $(archive).tar.gz $(archive).spdx.json SHA256SUMS

clean: ## remove what was built
	rm -rf $(BUILD) $(BUILD)-asan $(BUILD)-tsan $(BUILD)-fuzz $(BUILD)-undefined-fuzz $(BUILD)-coverage

# Sources that have moved or gone: dependencies of an older build may still name them.
sim/%.c: ;
render/%.c: ;
tests/%.c: ;

.PHONY: test-slow tarball image bare-test metadata twice release-check wheel deb deb-test staged dist check symbols all help deps deps-ci deps-arm64 arm64-test demo thesis gallery test fresh golden asan asan-short sanitized tsan coverage counted properties mutants fuzz fuzzers torture campaign bench stress lint man doc install uninstall clean always compile looked_through findings deps-peers peers
.DELETE_ON_ERROR:
# Not of what `make deb` builds meanwhile. To read them takes longer than what compiles nothing.
ifneq ($(filter-out staged uninstall,$(or $(MAKECMDGOALS),all)),)
-include $(shell find $(BUILD) -path $(BUILD)/deb -prune -o -type f -name '*.d' -print 2>/dev/null)
endif
