# Beadreel: `make help` lists what there is.
PREFIX  ?= /usr/local
DESTDIR ?=
BUILD   ?= build
CC      ?= cc
CFLAGS  ?= -O2 -g
WERROR  ?= -Werror

SIM_PACKAGES    = hdf5 yaml-0.1 udunits
RENDER_PACKAGES = osmesa libpng libavformat libavcodec libswscale libavutil cairo pangocairo
pkg-cflags      = $(shell pkg-config --cflags $(1) 2>/dev/null)
pkg-libs        = $(shell pkg-config --libs $(1) 2>/dev/null)

# Same bits on every machine: no contraction, no fast-math; see CONTRIBUTING in the README.
WARN  = -Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wvla -Wpointer-arith -Wwrite-strings $(WERROR)
MODE  = -std=c17 -D_GNU_SOURCE -fPIC -fvisibility=hidden -ffp-contract=off -fno-math-errno -fno-trapping-math -pthread
FLAGS = $(MODE) $(WARN) -Iinclude -I. -DBEAD_DATADIR='"$(PREFIX)/share/beadreel"' $(CPPFLAGS) $(CFLAGS) -MMD -MP

sim_cflags    := $(call pkg-cflags,$(SIM_PACKAGES))
sim_libs      := $(call pkg-libs,$(SIM_PACKAGES)) -lm -pthread
render_cflags := $(call pkg-cflags,$(RENDER_PACKAGES))
render_libs   := $(call pkg-libs,$(RENDER_PACKAGES)) -ldl

# The two mains and what they share (command line) stay out of the libraries.
SIM_SOURCES    = $(filter-out sim/beadsim.c sim/command_line.c, $(wildcard sim/*.c))
RENDER_SOURCES = $(filter-out render/beadreel.c, $(wildcard render/*.c))
SIM_OBJECTS    = $(SIM_SOURCES:%.c=$(BUILD)/%.o)
RENDER_OBJECTS = $(RENDER_SOURCES:%.c=$(BUILD)/%.o)
LIBRARIES      = $(BUILD)/libbeadsim.a $(BUILD)/libbeadreel.a $(BUILD)/libbeadsim.so $(BUILD)/libbeadreel.so
PROGRAMS       = $(BUILD)/beadsim $(BUILD)/beadreel

all: $(PROGRAMS) $(LIBRARIES)

$(BUILD)/sim/%.o: sim/%.c
	@mkdir -p $(@D)
	$(CC) $(FLAGS) $(sim_cflags) $(extra_$*) -c $< -o $@
$(BUILD)/render/%.o: render/%.c
	@mkdir -p $(@D)
	$(CC) $(FLAGS) $(sim_cflags) $(render_cflags) -c $< -o $@

# One source of the force kernels, compiled for each instruction set and chosen at run time.
extra_kernels_sse2   = -O3 -msse2
extra_kernels_avx2   = -O3 -mavx2
extra_kernels_avx512 = -O3 -mavx512f -mavx512dq -mavx512vl -mprefer-vector-width=512

$(BUILD)/libbeadsim.a: $(SIM_OBJECTS)
	rm -f $@ && ar rcs $@ $^
$(BUILD)/libbeadreel.a: $(RENDER_OBJECTS)
	rm -f $@ && ar rcs $@ $^
$(BUILD)/libbeadsim.so: $(SIM_OBJECTS)
	$(CC) -shared -Wl,-soname,libbeadsim.so $(CFLAGS) -o $@ $^ $(sim_libs)
$(BUILD)/libbeadreel.so: $(RENDER_OBJECTS) $(BUILD)/libbeadsim.so
	$(CC) -shared -Wl,-soname,libbeadreel.so $(CFLAGS) -o $@ $(RENDER_OBJECTS) -L$(BUILD) -lbeadsim $(render_libs) $(sim_libs)
$(BUILD)/beadsim: $(BUILD)/sim/beadsim.o $(BUILD)/sim/command_line.o $(BUILD)/libbeadsim.a
	$(CC) $(CFLAGS) -o $@ $^ $(sim_libs)
$(BUILD)/beadreel: $(BUILD)/render/beadreel.o $(BUILD)/sim/command_line.o $(BUILD)/libbeadreel.a $(BUILD)/libbeadsim.a
	$(CC) $(CFLAGS) -o $@ $^ $(render_libs) $(sim_libs)

# Unit tests: every tests/test_*.c is one cmocka program.
TESTS = $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/test_*.c))
$(BUILD)/tests/%: tests/%.c $(BUILD)/libbeadreel.a $(BUILD)/libbeadsim.a
	@mkdir -p $(@D)
	$(CC) $(FLAGS) -Itests $(sim_cflags) $(render_cflags) -o $@ $< $(BUILD)/libbeadreel.a $(BUILD)/libbeadsim.a $(render_libs) $(sim_libs) $(call pkg-libs,cmocka)

test: all $(TESTS)
	tests/run.sh $(BUILD)

clean:
	rm -rf $(BUILD)

.PHONY: all test clean
-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
