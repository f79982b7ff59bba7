# libcylint: `make help` lists what can be made.
#
# This file has the rules to build and install, tests/tests.mk those of tests,
# tools/bench/bench.mk those of benchmarks.  Everything is built below $(BUILD), one folder per configuration:
# `make BUILD=build/clang CC=clang`; `make -f FOLDER/Makefile` builds below the folder in which it runs.
# These variables are the user's; the project's own flags stand around them.
CC         ?= cc
CXX        ?= c++
AR         ?= ar
CFLAGS     ?= -O2 -g1
CXXFLAGS   ?= -O2 -g1
BUILD      ?= build$(if $(PARANOID),/paranoid)
PREFIX     ?= /usr/local
BINDIR     ?= $(PREFIX)/bin
LIBDIR     ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
MANDIR     ?= $(PREFIX)/share/man
DOCDIR     ?= $(PREFIX)/share/doc/cylint
BASHDIR    ?= $(PREFIX)/share/bash-completion/completions
ZSHDIR     ?= $(PREFIX)/share/zsh/site-functions
STRIP      ?= $(or $(shell $(CC) -print-prog-name=strip 2>/dev/null),strip)
# Some awks read and write decimal commas where the locale has them.
export LC_ALL := C

all: ## build the libraries and the commands

# ------------------------------------------------- jobs, output, probes --
# Jobs run in parallel; `make -j1` does one at a time.
ifeq ($(MAKELEVEL),0)
MAKEFLAGS += $(shell case " $$MAKEFLAGS" in (*\ -j* | \ [a-z]*j*) ;; \
               (*) echo -j`nproc 2>/dev/null || getconf _NPROCESSORS_ONLN` ;; esac)
endif
ifneq ($(filter clean uninstall,$(MAKECMDGOALS)),)
.NOTPARALLEL:
endif

quote = '$(subst ','\'',$(1))'

# In another folder a make in this one does the work.
here  := $(realpath $(dir $(lastword $(MAKEFILE_LIST))))
$(if $(here),,$(error the path of this Makefile has a space: use make -C FOLDER))
there := $(filter-out $(here),$(realpath .))
ifneq ($(there),)
$(or $(MAKECMDGOALS),all): there ;
there:
	@$(MAKE) --no-print-directory -C '$(here)' $(patsubst $(BUILD)/%,$(abspath $(BUILD))/%,$(MAKECMDGOALS)) \
	  $(foreach v,BUILD DESTDIR PREFIX,$(if $($v),$v=$(call quote,$(abspath $($v)))))
.PHONY: there $(or $(MAKECMDGOALS),all)
else
# Installed files name it.
override PREFIX := $(abspath $(PREFIX))
special := ' " ` \ $$ % * ? & | ; < > ( ) /~
$(foreach v,BUILD DESTDIR PREFIX,$(if $(word 2,x$($v))$(strip $(foreach c,$(special),$(findstring $c,/$($v)))),\
  $(error $v begins with ~ or has a space or one of $(filter-out /~,$(special)): $($v))))

# A step prints one short line; with V=1 it prints its command.
options := $(firstword -$(MAKEFLAGS))
say      = $(if $(V)$(findstring s,$(options)),,@echo '$(1)';)
quietly  = $(if $(V),,@)

# $(BUILD)/config.mk lists what this machine has: MPFR, PNG, EMBREE (3, 4
# or nothing), PTHREAD and so on.  `make MPFR= check` does without MPFR.  If the
# list changes, make writes the file and starts again; `deps` runs before that.
ifneq ($(filter-out help clean uninstall deps deps-%,$(or $(MAKECMDGOALS),all)),)
include $(BUILD)/config.mk
ifeq ($(origin EMBREE)$(filter deps,$(MAKECMDGOALS)),command line)
rtcore := embree$(EMBREE)/rtcore.h
$(if $(EMBREE),$(if $(shell $(CC) $(CPPFLAGS) $(EMBREE_CFLAGS) -include $(rtcore) -E -x c /dev/null >/dev/null 2>&1 && echo yes),,\
  $(error EMBREE=$(EMBREE): the compiler does not find $(rtcore); EMBREE_CFLAGS can name its folder)))
endif
endif
packages := $(if $(findstring n,$(options)),,$(patsubst deps,deps-debian,$(filter deps deps-cross,$(MAKECMDGOALS))))
# While apt-get runs, `deps check` compiles what depends on no package.
beside_apt := $(if $(packages),$(if $(MAKE_RESTARTS),,$(filter check,$(MAKECMDGOALS))))
$(BUILD)/config.mk: $(packages) $(beside_apt:check=without-packages) FORCE
	@CC=$(call quote,$(CC)) CXX=$(call quote,$(CXX)) CFLAGS=$(call quote,$(CFLAGS)) \
	  CXXFLAGS=$(call quote,$(CXXFLAGS)) sh tools/config.sh $@

without-packages:
	-@! command -v $(CC) >/dev/null || $(MAKE) --no-print-directory $(scene_library)

# ---------------------------------------------------------------- flags --
warnings := -Wall -Wextra -Wpedantic -Wconversion
exactly  := -ffp-contract=off -fno-fast-math
compile   = $(CC) -std=c99 $(warnings) -Iinclude -MMD -MP $(CPPFLAGS) $(CFLAGS) $(extra) $(exactly)

# mingw-w64: isinf() is a macro that converts to float, and gcc 12 assumes that
# the stack is aligned to 32 bytes (gcc bug 54412).
windows := $(findstring mingw,$(MACHINE))
ifneq ($(windows),)
warnings += -Wno-float-conversion
unaligned:= -Wa,-muse-unaligned-vector-move
static   := -DCYLINT_STATIC
endif

# Flags by folder.  With -O3 gcc vectorizes loops.  The SLP vectorizer of gcc 12
# compiles (double)(float)x to x where two of them are adjacent.  The BSDs declare more
# than POSIX has, sysconf() of processors for example, unless a program names POSIX.
posix   := $(if $(findstring bsd,$(MACHINE)),,-D_POSIX_C_SOURCE=200809L -D_DARWIN_C_SOURCE)
hidden  := -fPIC -fvisibility=hidden
floats  := -fno-tree-slp-vectorize
vectors := -O3
small   := -Os
threads := $(if $(PTHREAD),-pthread $(posix) -DCYLINT_THREADS)
x86     := $(if $(X86),-DCYLINT_BUILDS_X86)
# $(call of,PATTERN...): objects, and the files `flags` (below) of their folders
of       = $(addprefix $(BUILD)/,$(1) $(addsuffix flag%,$(sort $(dir $(1)))))
# Warnings in the headers of Embree are not ours.
embree  := $(if $(EMBREE),-DCYLINT_EMBREE=$(EMBREE)) $(EMBREE_CFLAGS:-I%=-isystem%)
$(BUILD)/src/%: extra := $(hidden) -DCYLINT_BUILDING $(x86) $(if $(PARANOID),-DCYLINT_PARANOID)
$(BUILD)/src/bvh/% $(BUILD)/src/scene/% $(BUILD)/src/embree/%: extra += $(floats) $(threads)
$(BUILD)/src/embree/%: extra += $(embree)
$(call of,src/filter/many% src/bvh/traverse% src/embree/packet_% src/embree/float_filter%): extra += $(vectors)
$(call of,src/roots/root% $(patsubst %,src/distance/%.o,exact_distance)): extra += $(small)
# The builds for x86 processors without AVX2.
$(if $(X86),$(call of,src/filter/one.o src/signs/origin.o src/distance/one_distance.o src/distance/elliptic_certain.o)): extra += $(small)
$(if $(X86),$(call of,src/distance/elliptic_certain.o)): extra += -DCYLINT_LOOPS
$(BUILD)/tools/%: extra := $(floats) $(posix) $(threads) $(static) -Itools/cylint
# The Python module has the command's readers.
$(BUILD)/tools/cylint/%: extra += $(hidden)

# Files that are built again for an instruction set: `isa.FILE-NAME` has the
# flags of FILE.c's build NAME.
avx2   := -mavx2 -mfma -mpopcnt $(unaligned)
avx512 := -mavx512f -mavx512vl -mavx512dq $(avx2)
isa.src/shapes/local-fma   := $(avx2) -DCYLINT_MEASURE_LOCAL=cylint_measure_local_fma
isa.src/signs/origin-fma   := $(avx2) -DCYLINT_SIGN_ON_LINE=cylint_sign_on_line_fma
isa.src/filter/one-fma     := $(avx2) -DCYLINT_ONE=cylint_one_fma -DCYLINT_SIGN_ON_LINE=cylint_sign_on_line_fma
isa.src/distance/one_distance-fma := $(avx2) -mprefer-vector-width=128 -DCYLINT_ONE_DISTANCES=cylint_one_distances_fma
isa.src/distance/elliptic_certain-fma := $(avx2) -mprefer-vector-width=128 -DCYLINT_ELLIPTIC_KERNELS=cylint_elliptic_kernels_fma
isa.src/distance/lanes-avx2   := $(avx2) -DCYLINT_DISTANCE_LANES=cylint_distance_lanes_avx2
isa.src/distance/lanes-avx512 := $(avx512) -DCYLINT_DISTANCE_LANES=cylint_distance_lanes_avx512
isa.src/filter/many-avx2   := $(avx2) -DCYLINT_MANY=cylint_many_avx2
isa.src/filter/many-avx512 := $(avx512) -DCYLINT_MANY=cylint_many_avx512
isa.src/filter/many_points-avx2   := $(avx2) -DCYLINT_SIDES=cylint_sides_avx2
isa.src/filter/many_points-avx512 := $(avx512) -DCYLINT_SIDES=cylint_sides_avx512
isa.src/bvh/traverse-avx2            := $(avx2) -DCYLINT_TRAVERSAL=cylint_traversal_avx2 -DCYLINT_TRAVERSE_POINT=cylint_traverse_point_avx2
isa.src/bvh/traverse-avx512          := $(avx512) -DCYLINT_TRAVERSAL=cylint_traversal_avx512 -DCYLINT_TRAVERSE_POINT=cylint_traverse_point_avx2
isa.src/bvh/traverse_point-avx2      := $(avx2) -DCYLINT_TRAVERSE_POINT=cylint_traverse_point_avx2
isa.src/embree/packet_traverse-avx2  := $(avx2) -DCYLINT_PACKET_TRACE=cylint_packet_trace_avx2
isa.src/embree/float_filter-fma      := $(avx2) -ffp-contract=fast -fno-math-errno -DCYLINT_ONE_LANE -DCYLINT_FLOAT_FILTER=cylint_float_filter_fma
isa.src/embree/float_filter-avx2     := $(avx2) -ffp-contract=fast -DCYLINT_FLOAT_FILTER=cylint_float_filter_avx2
isa_builds := $(if $(X86),$(sort $(patsubst isa.%,%,$(filter isa.%,$(.VARIABLES)))))

# -------------------------------------------------------------- objects --
# $(call objects,FOLDER...): the objects of all C files there, with all builds
objects = $(foreach d,$(1),$(patsubst %,$(BUILD)/%.o,$(filter $(d)/%,$(isa_builds)) $(patsubst %.c,%,$(wildcard $(d)/*.c))))
library_objects := $(call objects,src/distance src/filter src/roots src/signs src/shapes src/numbers src/methods) \
                   $(patsubst %.c,$(BUILD)/%.o,$(wildcard src/*.c))
scene_objects   := $(call objects,src/bvh src/scene)
embree_objects  := $(scene_objects) $(call objects,src/embree)
tool_objects    := $(filter-out %/numbers_c.o,$(call objects,tools/cylint)) \
                   $(BUILD)/tools/cylint/numbers_$(if $(CXX17),cxx,c).o

.SECONDEXPANSION:
$(BUILD)/%.o: %.c $$(@D)/flags
	$(call say,CC $<)$(compile) -c -o $@ $<

$(isa_builds:%=$(BUILD)/%.o): $(BUILD)/%.o: $$(firstword $$(subst -, ,$$*)).c $$(@D)/flags
	$(call say,CC $< $(lastword $(subst -, ,$*)))$(compile) $(isa.$*) -c -o $@ $<

$(BUILD)/tools/cylint/numbers_cxx.o: tools/cylint/numbers.cc $$(@D)/flags
	$(call say,CXX $<)$(CXX) -std=c++17 $(hidden) $(warnings) -MMD -MP $(CPPFLAGS) $(CXXFLAGS) -c -o $@ $<

# FOLDER/flags holds the commands that compile the folder's files, $(BUILD)/links those
# that link.  If they change, the file is written and what they make is made again.
folders := $(patsubst %/,%,$(sort $(dir $(wildcard src/*.c src/*/*.c tools/*/*.c tools/*/*/*.c tests/*.c tests/*/*.c))))
write    = @mkdir -p $(@D); text=$(call quote,$(1)); printf '%s\n' "$$text" | cmp -s - $@ || printf '%s\n' "$$text" >$@
$(folders:%=$(BUILD)/%/flags): $(BUILD)/%/flags: FORCE
	$(call write,$(compile) $(foreach b,$(filter $*/%,$(isa_builds)),$(isa.$b)) $(CXX) $(CXXFLAGS))
$(BUILD)/links: FORCE
	$(call write,$(CC) $(with_numbers) $(CFLAGS) $(LDFLAGS) $(LDLIBS) $(soname))

# ------------------------------------------------ libraries and programs --
# $(call shared,NAME) and $(call shared,NAME,VERSION) are file names, $(soname)
# the linker's flags, for ELF, macOS and Windows.  Under ELF the libraries find each
# other in their own folder.
shared  = $(1).so$(2:%=.%)
soname  = -shared -Wl,-soname,$(@F).$(major) -Wl,-rpath,'$$ORIGIN'
ifneq ($(findstring darwin,$(MACHINE)),)
shared  = $(1)$(2:%=.%).dylib
soname  = -dynamiclib -install_name $(LIBDIR)/$(call shared,$(basename $(@F)),$(major)) \
          -current_version $(version) -compatibility_version $(major)
else ifneq ($(windows),)
shared  = $(1).dll
soname  = -shared -Wl,--out-implib,$@.a
endif
version = $(shell sed -n 's/^.define CYLINT_VERSION "\(.*\)"/\1/p' include/cylint.h)
major   = $(firstword $(subst ., ,$(version)))

# libcylint-embree (for Embree 4: libcylint-embree4) holds all of
# libcylint-scene: a program that links the first needs no second.
threads_link := $(if $(PTHREAD),-pthread)
adapter      := libcylint-embree$(filter-out 3,$(EMBREE))
libraries    := libcylint libcylint-scene $(if $(EMBREE),$(adapter))
archive       = $(BUILD)/$(1).a
dynamic       = $(BUILD)/$(call shared,$(1))
$(call archive,libcylint)        $(call dynamic,libcylint):        $(library_objects)
$(call archive,libcylint-scene)  $(call dynamic,libcylint-scene):  $(scene_objects)
$(call archive,$(adapter)) $(call dynamic,$(adapter)): $(embree_objects)
$(call dynamic,libcylint-scene) $(call dynamic,$(adapter)): $(call dynamic,libcylint)
$(call dynamic,libcylint-scene): libs := $(threads_link)
$(call dynamic,$(adapter)): libs := $(EMBREE_LIBS) $(threads_link)

$(BUILD)/%.a:
	$(call say,AR $@)rm -f $@; $(AR) rcs $@ $^

$(call dynamic,lib%): $(BUILD)/links
	$(call say,LD $@)$(CC) $(CFLAGS) $(LDFLAGS) $(soname) -o $@ $(filter-out %/links,$^) $(libs) -lm

# $(link): a program of all its prerequisites
linker = $(CC)
link   = $(call say,LD $@)$(linker) $(CFLAGS) $(LDFLAGS) $(wrapped) -o $@ $(filter %.o,$^) $(filter %.a,$^) $(libs) $(LDLIBS) -lm
with_numbers  := $(if $(CXX17),$(CXX),$(CC))
scene_library := $(BUILD)/libcylint-scene.a $(BUILD)/libcylint.a

$(BUILD)/cylint: $(scene_library) $(tool_objects)
$(BUILD)/tools/cylint.a: $(filter-out %/main.o,$(tool_objects))
$(BUILD)/cylint-render: $(call objects,tools/render) $(BUILD)/tools/cylint.a $(scene_library)
$(BUILD)/cylint-render: libs := -lpng
commands := $(if $(POSIX),$(BUILD)/cylint $(if $(PNG),$(BUILD)/cylint-render))
$(commands) $(BUILD)/demo/cylint: linker = $(with_numbers) -pthread
$(commands) $(BUILD)/demo/cylint: $(BUILD)/links
	@mkdir -p $(@D)
	$(link)

all: $(foreach l,$(libraries),$(call archive,$l)) $(commands) $(foreach l,$(libraries),$(call dynamic,$l))

# The demo's command has only the builds for every processor, which are half of what
# there is to compile: the files that choose a build are compiled without the others.
choosing := $(if $(X86),$(basename $(shell grep -l 'dispatch[.]h"' src/*.c src/*/*.c)))
$(choosing:%=$(BUILD)/%-portable.o): $(BUILD)/%-portable.o: %.c $$(@D)/flags
	$(call say,CC $< portable)$(compile) -UCYLINT_BUILDS_X86 -c -o $@ $<
$(BUILD)/demo/cylint: $(filter-out $(isa_builds:%=$(BUILD)/%.o) $(choosing:%=$(BUILD)/%.o),$(library_objects) $(scene_objects)) \
	$(patsubst %,$(BUILD)/%-portable.o,$(filter-out src/embree/%,$(choosing))) $(tool_objects)
demo: $(BUILD)/demo/cylint ## scan a generated forest and show what was hit
	@BUILD=$(BUILD) CYLINT=$< sh tools/demo/demo.sh

include tests/tests.mk
include tools/bench/bench.mk
include tools/package/package.mk

# -------------------------------------------------------------- install --
# Everybody may read the files, whatever the umask.
fill_in = umask 022 && sed -e 's|@PREFIX@|$(PREFIX)|; s|@LIBDIR@|$(LIBDIR)|; s|@BINDIR@|$(BINDIR)|; s|@INCLUDEDIR@|$(INCLUDEDIR)|; s|@VERSION@|$(version)|; s|@EMBREE_LIBS@|$(EMBREE_LIBS)|'
# What the .pc files say: their folders below $(PREFIX) move with it.  The adapter needs
# Embree; all libraries but the first need the first, and threads.
about.libcylint       = where a line meets a cylinder or a cone, exactly
about.libcylint-scene = one line against very many cylinders and cones, exactly
about.$(adapter)      = cylinders and cones in an Embree $(EMBREE) scene, exactly
of_adapter = $(if $(filter $(adapter),$(1)),$(2))
not_first  = $(if $(filter-out libcylint,$(1)),$(2))
fill_in_pc = $(fill_in) -e 's|@NAME@|$(1:lib%=%)|; s|@ABOUT@|$(about.$(1))|; s|@REQUIRES@|$(call not_first,$(1),cylint = $(version))|; s|dir=$(PREFIX)/|dir=$${prefix}/|' \
	  -e 's|@THREADS@|$(call not_first,$(1),$(threads_link))|; s|@LIBS@|$(call of_adapter,$(1),$(EMBREE_LIBS))|; s|@CFLAGS@|$(call of_adapter,$(1),$(EMBREE_CFLAGS))|'
headers  = $(patsubst %,include/%.h,cylint cylint_distance cylint_methods cylint_pieces cylint_scene $(if $(EMBREE),cylint_embree))

# $(call install_library,NAME): strip writes no index of objects of -flto.
ifneq ($(windows),)
install_shared = install -m 755 $(call dynamic,$(1)) $(DESTDIR)$(BINDIR) && \
	$(STRIP) -S -x $(DESTDIR)$(BINDIR)/$(call shared,$(1)) && \
	install -m 644 $(call dynamic,$(1)).a $(DESTDIR)$(LIBDIR)
else
install_shared = install -m 755 $(call dynamic,$(1)) $(DESTDIR)$(LIBDIR)/$(call shared,$(1),$(version)) && \
	cd $(DESTDIR)$(LIBDIR) && $(STRIP) -S -x $(call shared,$(1),$(version)) && \
	ln -sf $(call shared,$(1),$(version)) $(call shared,$(1),$(major)) && ln -sf $(call shared,$(1),$(major)) $(call shared,$(1))
endif
define install_library
$(call say,INSTALL $(DESTDIR)$(LIBDIR)/$(1).*)install -m 644 $(BUILD)/$(1).a $(DESTDIR)$(LIBDIR)
	$(quietly)$(STRIP) -S $(DESTDIR)$(LIBDIR)/$(1).a && $(AR) s $(DESTDIR)$(LIBDIR)/$(1).a
	$(quietly)$(install_shared)
	$(quietly)$(call fill_in_pc,$(1)) src/library.pc.in > $(DESTDIR)$(LIBDIR)/pkgconfig/$(1:lib%=%).pc

endef

# Folders of this project alone, then those that others use as well.
own_folders = $(PREFIX)/share/cylint $(DOCDIR) $(LIBDIR)/cmake/cylint
folders_of  = sh tools/install_folders.sh $(1) '$(DESTDIR)' $(PREFIX)/share/cylint/folders $(own_folders)
programs    = cylint cylint-render
completions = $(programs:%=$(DESTDIR)$(BASHDIR)/%) $(DESTDIR)$(ZSHDIR)/_cylint

install-folders:
	$(quietly)$(call folders_of,make) $(BINDIR) $(LIBDIR)/pkgconfig $(INCLUDEDIR) $(BASHDIR) $(ZSHDIR) $(patsubst %,$(MANDIR)/man%,1 3 7)

# STRIP=: leaves the symbols for debuggers in the installed files.
install: all install-folders ## install into $(DESTDIR)$(PREFIX)
	$(if $(commands),$(call say,INSTALL $(commands:$(BUILD)/%=$(DESTDIR)$(BINDIR)/%))install -m 755 $(commands) $(DESTDIR)$(BINDIR))
	$(if $(commands),$(quietly)$(STRIP) $(commands:$(BUILD)/%=$(DESTDIR)$(BINDIR)/%))
	$(foreach l,$(libraries),$(call install_library,$l))
	$(call say,INSTALL $(DESTDIR)$(INCLUDEDIR)/cylint*.h)install -m 644 $(headers) $(DESTDIR)$(INCLUDEDIR)
	$(call say,INSTALL $(DESTDIR)$(MANDIR)/man*/cylint*)$(foreach s,1 3 7,install -m 644 $(wildcard man/*.$s) $(DESTDIR)$(MANDIR)/man$s &&) true
	$(call say,INSTALL $(DESTDIR)$(PREFIX)/share: documents and completions)install -m 644 README.md LICENSE man/CHANGES.md $(DESTDIR)$(DOCDIR)
	$(quietly)install -m 644 tools/render/autumn.awk $(DESTDIR)$(PREFIX)/share/cylint
	$(quietly)for file in $(completions); do install -m 644 tools/cylint/completion $$file || exit; done
	@$(if $(DESTDIR),,sh tools/install_hints.sh '$(BINDIR)' '$(LIBDIR)' '$(MANDIR)')

uninstall: ## remove what install wrote
	rm -f $(programs:%=$(DESTDIR)$(BINDIR)/%) $(completions) \
	  $(patsubst include/%,$(DESTDIR)$(INCLUDEDIR)/%,$(wildcard include/*.h)) \
	  $(foreach s,1 3 7,$(patsubst man/%,$(DESTDIR)$(MANDIR)/man$s/%,$(wildcard man/*.$s))) \
	  $(foreach l,cylint cylint-scene cylint-embree cylint-embree4,$(DESTDIR)$(LIBDIR)/lib$l.* $(DESTDIR)$(LIBDIR)/pkgconfig/$l.pc) \
	  $(DESTDIR)$(PREFIX)/share/cylint/*.awk $(addprefix $(DESTDIR)$(DOCDIR)/,README.md LICENSE CHANGES.md)
	$(call folders_of,remove)

clean: ## remove $(BUILD)
	rm -rf $(BUILD)

help: ## print this list
	@sed -n 's/^\([a-z0-9-]*\):.*## \(.*\)/\1	\2/p' Makefile tests/tests.mk tools/bench/bench.mk tools/package/package.mk

.PHONY: all without-packages demo install install-folders uninstall clean help FORCE
.SECONDARY:
.DELETE_ON_ERROR:
.SUFFIXES:
$(BUILD)/%.d: ;
-include $(wildcard $(folders:%=$(BUILD)/%/*.d))
endif
