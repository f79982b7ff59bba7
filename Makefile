# libcylint: `make help` lists what can be made.
# CC CXX CFLAGS CPPFLAGS LDFLAGS LDLIBS AR PREFIX BINDIR LIBDIR INCLUDEDIR
# MANDIR DESTDIR PKG_CONFIG are yours; ours stand around them.
CC         ?= cc
CXX        ?= c++
PKG_CONFIG ?= pkg-config
CFLAGS     ?= -O2 -g
CXXFLAGS   ?= -O2 -g
PARANOID   ?=
BUILD      ?= build$(if $(PARANOID),/paranoid)
PREFIX     ?= /usr/local
BINDIR     ?= $(PREFIX)/bin
LIBDIR     ?= $(PREFIX)/lib
INCLUDEDIR ?= $(PREFIX)/include
MANDIR     ?= $(PREFIX)/share/man

version := $(shell sed -n 's/^.define CYLINT_VERSION "\(.*\)"/\1/p' include/cylint.h)
major   := $(firstword $(subst ., ,$(version)))

comma   := ,

# What is optional: `make MPFR= check` and the like switch it off.
$(shell mkdir -p $(BUILD))
have     = $(shell p=$(BUILD)/.probe$$$$; echo 'int main(void){return 0;}' | \
             $(1) -o $$p -x $(2) - $(3) 2>&1 || echo no; rm -f $$p)
optional = $(if $(filter undefined,$(origin $(1))),$(eval $(1) := $(if $(call have,$(2),$(3),$(4)),,yes)))
$(call optional,CXX17,$(CXX) -std=c++17 -include charconv,c++)
$(call optional,MPFR,$(CC) -include stdio.h -include mpfr.h,c,-lmpfr -lgmp)
$(call optional,GSL,$(CC) -include gsl/gsl_rng.h,c,-lgsl -lgslcblas -lm)
$(call optional,PNG,$(CC) -include png.h,c,-lpng)
$(call optional,PTHREAD,$(CC) -pthread -include pthread.h,c)
# a linker that puts a test's read() in the place of the system's
$(call optional,WRAP,$(CC) -Wl$(comma)--wrap=read,c)
# EMBREE is 3, 4 or nothing; EMBREE_CFLAGS and EMBREE_LIBS say where it is.
embree   = $(if $(call have,$(CC) $(EMBREE_CFLAGS) -include embree$(1)/rtcore.h,c,$(or $(EMBREE_LIBS),-lembree$(1))),,$(1))
ifeq ($(origin EMBREE),undefined)
EMBREE        := $(or $(call embree,4),$(call embree,3))
endif
EMBREE_LIBS   ?= -lembree$(EMBREE)

warn    := -Wall -Wextra -Wpedantic -Wconversion
ours    := -std=c99 $(warn) -Iinclude -MMD -MP
exactly := -ffp-contract=off -fno-fast-math
# gcc 12 with this on takes (double)(float)x for x where it finds two in a row
floats  := -fno-tree-slp-vectorize
compile  = $(CC) $(ours) $(CPPFLAGS) $(CFLAGS) $(extra) $(exactly)

lib_objects   := $(patsubst src/%.c,$(BUILD)/src/%.o,$(wildcard src/*.c $(patsubst %,src/%/*.c,numbers shapes signs roots filter methods)))
# kernels once more for each instruction set of this machine's family
ifneq ($(filter x86_64%,$(shell $(CC) -dumpmachine)),)
lib_objects   += $(patsubst %,$(BUILD)/src/filter/%.o,one_question-fma one_question-avx512 many_questions-avx2 many_questions-avx512)
bvh_builds    := $(BUILD)/src/bvh/traverse-avx2.o
embree_builds := $(patsubst %,$(BUILD)/src/embree/%.o,packet_traverse-avx2 float_filter-fma packet_filter-avx2 packet_filter-avx512)
endif
scene_objects  := $(patsubst src/%.c,$(BUILD)/src/%.o,$(wildcard src/bvh/*.c src/scene/*.c)) $(bvh_builds)
embree_objects := $(patsubst src/%.c,$(BUILD)/src/%.o,$(wildcard src/embree/*.c)) $(embree_builds)
FLAGS.fma     := -mavx2 -mfma -DCYLINT_ONE=cylint_one_fma
FLAGS.avx2    := -mavx2 -mfma -DCYLINT_MANY=cylint_many_avx2
avx512        := -mavx512f -mavx512vl -mavx512dq -mavx2 -mfma
FLAGS.avx512  := $(avx512) -DCYLINT_ONE=cylint_one_avx512 -DCYLINT_MANY=cylint_many_avx512
tool_sources  := $(filter-out tools/cylint/numbers_c.c,$(wildcard tools/cylint/*.c))
tool_objects  := $(patsubst %.c,$(BUILD)/%.o,$(tool_sources)) \
                 $(BUILD)/tools/cylint/$(if $(CXX17),numbers_cxx.o,numbers_c.o)
scene_library := $(BUILD)/libcylint-scene.a $(BUILD)/libcylint.a
test_common   := $(BUILD)/tests/families.o $(BUILD)/tests/constructed.o $(if $(MPFR),$(BUILD)/tests/oracle.o)
test_programs := $(patsubst tests/%.c,$(BUILD)/tests/%,$(wildcard tests/test_*.c))
scene_tests   := $(filter $(BUILD)/tests/test_scene%,$(test_programs))
embree_tests  := $(filter $(BUILD)/tests/test_embree%,$(test_programs))
test_programs := $(if $(EMBREE),$(test_programs),$(filter-out $(embree_tests),$(test_programs)))
test_scripts  := $(wildcard tests/test_*.sh)
test_libs     := $(if $(MPFR),-lmpfr -lgmp) $(if $(GSL),-lgsl -lgslcblas)

# libcylint-embree has all that libcylint-scene has: one of them is enough
threads_link := $(if $(PTHREAD),-pthread)
libraries := libcylint libcylint-scene $(if $(EMBREE),libcylint-embree)
all: $(foreach l,$(libraries),$(BUILD)/$(l).a $(BUILD)/$(l).so) $(BUILD)/cylint ## the libraries and the command

$(BUILD)/libcylint.a $(BUILD)/libcylint.so: $(lib_objects)
$(BUILD)/libcylint-scene.a $(BUILD)/libcylint-scene.so: $(scene_objects)
$(BUILD)/libcylint-embree.a $(BUILD)/libcylint-embree.so: $(scene_objects) $(embree_objects)
$(BUILD)/libcylint-scene.so $(BUILD)/libcylint-embree.so: $(BUILD)/libcylint.so
$(BUILD)/libcylint-scene.so: needs := $(threads_link)
$(BUILD)/libcylint-embree.so: needs := $(EMBREE_LIBS) $(threads_link)

$(BUILD)/lib%.a:
	$(AR) rcs $@ $^

$(BUILD)/lib%.so:
	$(CC) $(CFLAGS) $(LDFLAGS) -shared -Wl,-soname,$(@F).$(major) -o $@ $^ $(needs) -lm

# The command, and once more with calls that fail as tests/faults.c is told.
faulty_calls := read write poll open close malloc calloc realloc posix_memalign free pipe pthread_create
$(BUILD)/tests/faulty: $(BUILD)/tests/faults.o
$(BUILD)/tests/faulty: wrapped := $(foreach c,$(faulty_calls),-Wl,--wrap=$(c))
$(BUILD)/cylint $(BUILD)/tests/faulty: $(tool_objects) $(scene_library)
	$(if $(CXX17),$(CXX),$(CC)) $(CFLAGS) $(LDFLAGS) -pthread $(wrapped) -o $@ $^ $(LDLIBS) -lm

# Pictures of scenes; scenes are read as the command reads them.
all: $(if $(PNG),$(BUILD)/cylint-render)

$(BUILD)/tools/cylint.a: $(filter-out %/main.o,$(tool_objects))
	$(AR) rcs $@ $^

$(BUILD)/cylint-render: $(patsubst %.c,$(BUILD)/%.o,$(wildcard tools/render/*.c)) \
		$(BUILD)/tools/cylint.a $(scene_library)
	$(if $(CXX17),$(CXX),$(CC)) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(LDLIBS) -lpng -pthread -lm

$(BUILD)/tests/pixels: $(BUILD)/tests/pixels.o
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -lpng

$(BUILD)/src/%.o: extra := -fPIC -fvisibility=hidden -DCYLINT_BUILDING $(if $(PARANOID),-DCYLINT_PARANOID)
threads := $(if $(PTHREAD),-pthread -D_POSIX_C_SOURCE=200809L -DCYLINT_THREADS)
$(BUILD)/src/bvh/%.o $(BUILD)/src/scene/%.o: extra += $(floats) $(threads) $(if $(bvh_builds),-DCYLINT_BUILDS_X86)
$(BUILD)/src/embree/%.o: extra += $(floats) $(threads) $(if $(embree_builds),-DCYLINT_BUILDS_X86) -DCYLINT_EMBREE=$(EMBREE) $(EMBREE_CFLAGS)
$(BUILD)/tools/%.o: extra := $(floats) -D_POSIX_C_SOURCE=200809L
$(BUILD)/tools/render/%.o: extra := $(floats) -D_POSIX_C_SOURCE=200809L -Itools/cylint
$(BUILD)/tools/bench/%.o: extra := $(floats) -D_POSIX_C_SOURCE=200809L -Isrc -Itests \
	$(if $(MPFR),-DHAVE_MPFR) $(if $(GSL),-DHAVE_GSL)
$(BUILD)/tests/%.o: extra := $(floats) -D_POSIX_C_SOURCE=200809L -Isrc -Itests \
	$(if $(MPFR),-DHAVE_MPFR) $(if $(GSL),-DHAVE_GSL)
$(BUILD)/tests/embree_%.o $(BUILD)/tests/test_embree_%.o $(BUILD)/tests/scene_curves.o: extra += -DCYLINT_EMBREE=$(EMBREE) $(EMBREE_CFLAGS)

$(BUILD)/src/dispatch.o: extra += $(if $(findstring one_question-fma,$(lib_objects)),-DCYLINT_BUILDS_X86)
# what gcc needs to make vectors of loops
vectors := -O3
$(BUILD)/src/filter/%.o $(BUILD)/src/bvh/traverse%.o $(BUILD)/src/bvh/build.o $(BUILD)/src/embree/float_filter%.o $(BUILD)/src/embree/packet_%.o: extra += $(vectors)

$(BUILD)/%.o: %.c
	@mkdir -p $(@D)
	$(compile) -c -o $@ $<

$(BUILD)/src/filter/one_question-%.o: src/filter/one_question.c
	@mkdir -p $(@D)
	$(compile) $(FLAGS.$*) -c -o $@ $<

$(BUILD)/src/filter/many_questions-%.o: src/filter/many_questions.c
	@mkdir -p $(@D)
	$(compile) $(FLAGS.$*) -c -o $@ $<

$(BUILD)/src/bvh/traverse-avx2.o: src/bvh/traverse.c
	$(compile) -mavx2 -mfma -DCYLINT_TRAVERSAL=cylint_traversal_avx2 -c -o $@ $<
$(BUILD)/src/embree/packet_traverse-avx2.o: src/embree/packet_traverse.c
	$(compile) -mavx2 -mfma -DCYLINT_TRAVERSAL=cylint_traversal_avx2 -DCYLINT_TRAVERSE_PACKET=cylint_traverse_packet_avx2 -c -o $@ $<
$(BUILD)/src/embree/float_filter-%.o: src/embree/float_filter.c
	$(compile) -mavx2 -mfma -ffp-contract=fast -DCYLINT_FLOAT_FILTER=cylint_float_filter_$* -c -o $@ $<
$(BUILD)/src/embree/packet_filter-%.o: src/embree/packet_filter.c
	$(compile) $(if $(filter avx512,$*),$(avx512),-mavx2 -mfma) -ffp-contract=fast -DCYLINT_PACKET_FILTER=cylint_packet_filter_$* -c -o $@ $<

$(BUILD)/tools/cylint/numbers_cxx.o: tools/cylint/numbers.cc
	@mkdir -p $(@D)
	$(CXX) -std=c++17 $(warn) -MMD -MP $(CPPFLAGS) $(CXXFLAGS) -c -o $@ $<

$(BUILD)/tests/test_batch: test_libs += -pthread
$(BUILD)/tests/test_%: $(BUILD)/tests/test_%.o $(test_common) $(BUILD)/libcylint.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(test_libs) -lm

$(BUILD)/tests/test_scene_memory.o: extra += $(if $(WRAP),-DWRAPPED)
$(BUILD)/tests/test_scene_memory: wrapped := $(if $(WRAP),$(foreach c,malloc calloc free,-Wl$(comma)--wrap=$(c)))
$(scene_tests): %: %.o $(BUILD)/tests/scenes.o $(test_common) $(scene_library)
	$(CC) $(CFLAGS) $(LDFLAGS) $(wrapped) -o $@ $^ $(test_libs) -pthread -lm

$(embree_tests): $(patsubst %,$(BUILD)/tests/%.o,embree_rays embree_world)
$(embree_tests) $(BUILD)/tests/scene_curves: %: %.o $(BUILD)/tests/scenes.o $(test_common) $(BUILD)/libcylint-embree.a $(BUILD)/libcylint.a
	$(CC) $(CFLAGS) $(LDFLAGS) $(wrapped) -o $@ $(filter %.o,$^) $(filter %.a,$^) $(EMBREE_LIBS) $(test_libs) -pthread -lm

# A target of tests/fuzz runs under libFuzzer (FUZZER=yes, by `make fuzz`) or
# replays files; in the fuzzed command the test reads and writes.
fuzz_programs := $(patsubst %,$(BUILD)/tests/fuzz/%,record command shapes)
fuzz_calls    := $(foreach c,open read write close,-Wl,--wrap=$(c))
$(BUILD)/tests/fuzz/main.o: tools/cylint/main.c
	@mkdir -p $(@D)
	$(compile) -D_POSIX_C_SOURCE=200809L -Dmain=command_main -c -o $@ $<
$(BUILD)/tests/fuzz/command: wrapped := $(fuzz_calls) -pthread
$(fuzz_programs): %: %.o $(BUILD)/tests/fuzz/main.o $(if $(FUZZER),,$(BUILD)/tests/fuzz/replay.o) $(filter-out %/main.o,$(tool_objects)) $(scene_library)
	$(if $(CXX17),$(CXX),$(CC)) $(CFLAGS) $(LDFLAGS) $(if $(FUZZER),-fsanitize=fuzzer) $(wrapped) -o $@ $^ $(LDLIBS) -lm

.PHONY: fuzz fuzz_programs
fuzz_programs: $(fuzz_programs)

sanitized := -fsanitize=address,undefined -fno-sanitize-recover=all
fuzzed := -fsanitize=fuzzer-no-link -fno-sanitize-coverage=trace-cmp $(sanitized)
fuzz: ## libFuzzer on tests/fuzz; SECONDS=60 each (needs clang)
	$(MAKE) -s BUILD=$(BUILD)/fuzz FUZZER=yes PARANOID=1 CC=clang CXX=clang++ \
	  CPPFLAGS=-DCYLINT_SHRINK=1024 CFLAGS='-g -O1 $(fuzzed)' \
	  CXXFLAGS='-g -O1 $(fuzzed)' fuzz_programs
	@BUILD=$(BUILD)/fuzz SECONDS=$(or $(SECONDS),60) sh tests/fuzz/fuzz.sh

# Long runs, not part of `make check`; what they take is said in each file.
$(BUILD)/tests/stress $(BUILD)/tests/search $(BUILD)/tests/records: %: %.o $(test_common) $(BUILD)/libcylint.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(test_libs) -lm

# Where the processor has fused multiply-add, a second build with it.
bench_programs := $(BUILD)/tools/bench/cost $(BUILD)/tools/bench/methods $(BUILD)/tools/bench/batch
bench_common   := $(patsubst %,$(BUILD)/tools/bench/%.o,contestants race timing plain shader $(if $(GSL),gsl_quadratic))
FMA            ?= $(shell echo 'int main(void){return !__builtin_cpu_supports("fma");}' > $(BUILD)/.fma.c && \
                    $(CC) -mfma -o $(BUILD)/.fma $(BUILD)/.fma.c 2>/dev/null && $(BUILD)/.fma && echo yes)
$(BUILD)/tools/bench/cost: $(BUILD)/tools/bench/cost_inputs.o
$(BUILD)/tools/bench/methods: $(patsubst %,$(BUILD)/tools/bench/%.o,classes statistics truth)
$(BUILD)/tools/bench/batch: $(patsubst %,$(BUILD)/tools/bench/%.o,batch_scene batch_turns batch_core batch_cases classes cost_inputs)
$(bench_programs): %: %.o $(bench_common) $(test_common) $(BUILD)/libcylint.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(test_libs) -lm

$(BUILD)/tools/bench/scene: %: %.o $(BUILD)/tests/scenes.o $(scene_library)
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ -pthread -lm

.PHONY: bench-scene check-scene
bench-scene: $(BUILD)/tools/bench/scene ## scenes against asking every shape
	@BUILD='$(BUILD)' sh tools/bench/scene.sh

bench_programs: $(bench_programs)

$(BUILD)/tools/bench/embree.o $(BUILD)/tools/bench/embree_%.o: extra += -DCYLINT_EMBREE=$(EMBREE) $(EMBREE_CFLAGS)
$(BUILD)/tools/bench/embree $(BUILD)/tools/bench/embree_packets: %: %.o $(patsubst %,$(BUILD)/tools/bench/%.o,embree_scenes embree_rivals timing) $(BUILD)/libcylint-embree.a $(BUILD)/libcylint.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(EMBREE_LIBS) -lm

$(BUILD)/tools/bench/embree_threads: $(patsubst %,$(BUILD)/tools/bench/%.o,embree_threads embree_scenes embree_rivals) $(BUILD)/libcylint-embree.a $(BUILD)/libcylint.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(EMBREE_LIBS) -pthread -lm

# what a ray is asked for: an adapter that counts
counted := cylint_float_filter_used cylint_intersect
$(BUILD)/tools/bench/embree_counts: $(patsubst %,$(BUILD)/tools/bench/%.o,embree_counts embree_scenes embree_rivals) $(BUILD)/libcylint-embree.a $(BUILD)/libcylint.a
	$(CC) $(CFLAGS) $(LDFLAGS) $(foreach f,$(counted),-Wl,--wrap=$(f)) -o $@ $^ $(EMBREE_LIBS) -lm

.PHONY: bench-embree count_visits
count_visits: $(BUILD)/tools/bench/embree_counts
	$< $(if $(QUICK),1e5,1e6)
bench-embree: $(patsubst %,$(BUILD)/tools/bench/%,embree embree_packets embree_threads) ## scenes beside Embree's own curves; QUICK=1: in a minute
	$(BUILD)/tools/bench/embree $(if $(QUICK),0.5 1e5,5 1e7) | tee $(BUILD)/embree.tsv
	$(BUILD)/tools/bench/embree_packets $(if $(QUICK),0.5 1e5,5 1e7) | tee $(BUILD)/embree-packets.tsv
	$(BUILD)/tools/bench/embree_threads 2 $(if $(QUICK),1e5,1e6) | tee $(BUILD)/embree-threads.tsv
	@$(if $(WRAP),$(MAKE) -s BUILD=$(BUILD)/visits CPPFLAGS='$(CPPFLAGS) -DCYLINT_COUNT_VISITS' count_visits | tee $(BUILD)/embree-counts.tsv)

bench: bench_programs ## time against error, tables and charts; QUICK=1: in two minutes
	@$(if $(GSL),,echo 'bench: no GSL, so no questions to ask (make deps)'; exit 1)
	@$(if $(MPFR),,echo 'note: no MPFR, errors are not measured')
	@$(if $(FMA),$(MAKE) BUILD=$(BUILD)/fma CFLAGS='$(CFLAGS) -mfma' bench_programs)
	@BUILD='$(BUILD)' CC='$(CC)' CFLAGS='$(CFLAGS)' FMA='$(FMA)' QUICK='$(QUICK)' sh tools/bench/bench.sh

# How far questions must go: a library that counts.
.PHONY: stages count_stages
$(BUILD)/tools/bench/stages: %: %.o $(test_common) $(BUILD)/libcylint.a
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^ $(test_libs) -lm
count_stages: $(BUILD)/tools/bench/stages
	$< $(CASES)
stages: ## share of questions that need pairs, exact digits, ..., by family
	$(MAKE) -s BUILD=$(BUILD)/stages CPPFLAGS='$(CPPFLAGS) -DCYLINT_COUNT_STAGES' count_stages

$(BUILD)/tools/bench/measure: $(BUILD)/tools/bench/measure.o
	$(CC) $(CFLAGS) $(LDFLAGS) -o $@ $^

bench-text: all $(BUILD)/tools/bench/measure ## the command beside what else reads numbers; QUICK=1
	@BUILD='$(BUILD)' QUICK='$(QUICK)' sh tools/bench/text.sh

stress: $(BUILD)/tests/stress ## 1e8 cases against the oracle, an hour or less
	$(BUILD)/tests/stress

search: $(BUILD)/tests/search ## hill climbing for the worst errors and the slowest query
	$(BUILD)/tests/search

check-scene: $(BUILD)/tests/test_scene $(if $(EMBREE),$(BUILD)/tests/scene_curves) ## scenes against brute force, two minutes or so
	$(BUILD)/tests/test_scene 1000
	$(if $(EMBREE),$(BUILD)/tests/scene_curves)

covered: all $(test_programs)
	@BUILD=$(BUILD) CC='$(CC)' sh tests/run.sh $(test_programs) tests/test_hard.sh

# counters that threads share are wrong, even negative, unless they are atomic
counting := -g -O0 --coverage -fprofile-update=atomic -fno-math-errno
coverage: ## branches of src/ that no test takes, and no reason is known for
	rm -rf $(BUILD)/coverage
	$(MAKE) BUILD=$(BUILD)/coverage vectors= CFLAGS='$(counting)' CXXFLAGS='$(counting)' covered
	python3 tests/coverage.py $(BUILD)/coverage

mutants: ## do the tests see a changed operator, constant or index? COUNT=20 a file
	python3 tests/mutants.py --cc '$(CC)' --count $(or $(COUNT),20)

check-cross: $(BUILD)/tests/records ## the same bytes from other compilers and processors
	@BUILD=$(BUILD) sh tests/cross.sh

check-cluster: all ## cylint by GNU parallel, Slurm and Spark, as cylint(7) says
	@BUILD=$(BUILD) sh tests/cluster/check.sh

lint: ## what static analysis says, and how the sources look
	@BUILD=$(BUILD) CC='$(CC)' sh tests/lint.sh

demo: all ## scan a generated forest and show what was hit
	@BUILD=$(BUILD) sh tools/demo/demo.sh

check: all $(test_programs) $(if $(WRAP),$(BUILD)/tests/faulty $(fuzz_programs)) $(if $(PNG),$(BUILD)/tests/pixels) ## run every test (PARANOID=1: each decision twice)
	@$(if $(MPFR),,echo 'note: no MPFR, tests against the oracle are skipped')
	@$(if $(EMBREE),,echo 'note: no Embree, its adapter is neither built nor tested')
	@$(if $(PNG),,echo 'note: no libpng, cylint-render is neither built nor tested')
	@BUILD=$(BUILD) CC='$(CC)' CXX='$(CXX)' CXX17='$(CXX17)' PARANOID='$(PARANOID)' sh tests/run.sh $(test_programs) $(test_scripts)

check-embree: $(embree_tests) ## the tests that need Embree, on the one that was found
	@$(if $(EMBREE),,echo 'check-embree: no Embree (make deps)'; exit 1)
	@BUILD=$(BUILD) sh tests/run.sh $(filter $(embree_tests),$(test_programs))

check-embree4: all ## the same on Embree 4, fetched from PyPI
	@BUILD=$(BUILD) CC='$(CC)' sh tests/run.sh tests/test_embree4.sh

prove: ## the error bounds, by Gappa; 1 % less must not be provable
	@BUILD=$(BUILD) CC='$(CC)' sh tests/prove/prove.sh

sanitize: ## the tests under the address and undefined-behaviour sanitizers
	$(MAKE) BUILD=$(BUILD)/sanitize check \
	  CFLAGS='-g -O1 $(sanitized)' CXXFLAGS='-g -O1 $(sanitized)'

threaded := -g -O1 -fsanitize=thread
.PHONY: check-threads faulty
faulty: $(BUILD)/cylint $(BUILD)/tests/faulty
check-threads: ## threads build and ask scenes, 8 workers, under the thread sanitizer
	$(MAKE) BUILD=$(BUILD)/threads CFLAGS='$(threaded)' CXXFLAGS='$(threaded)' faulty \
	  $(BUILD)/threads/tests/test_scene_tree $(if $(EMBREE),$(BUILD)/threads/tests/test_embree_threads) $(if $(PNG),$(BUILD)/threads/cylint-render)
	TSAN_OPTIONS=exitcode=66 $(BUILD)/threads/tests/test_scene_tree
	$(if $(EMBREE),TSAN_OPTIONS=exitcode=66 $(BUILD)/threads/tests/test_embree_threads)
	BUILD=$(BUILD)/threads WORKERS=8 sh tests/test_faults.sh
	$(if $(PNG),BUILD=$(BUILD)/threads sh tests/render_threads.sh)

deps: ## install what the tests need (Debian)
	@sh tools/deps.sh

deps-cross: ## what check-cross and lint need as well (Debian)
	@sh tools/deps.sh cross

fill_in = sed -e 's|@PREFIX@|$(PREFIX)|; s|@LIBDIR@|$(LIBDIR)|; s|@INCLUDEDIR@|$(INCLUDEDIR)|; s|@VERSION@|$(version)|' \
	  -e 's|@THREADS@|$(threads_link)|; s|@EMBREE@|$(EMBREE)|; s|@EMBREE_LIBS@|$(EMBREE_LIBS)|; s|@EMBREE_CFLAGS@|$(EMBREE_CFLAGS)|'

# $(call install_library,libcylint...)
define install_library
install -m 644 $(BUILD)/$(1).a $(DESTDIR)$(LIBDIR)
	install -m 755 $(BUILD)/$(1).so $(DESTDIR)$(LIBDIR)/$(1).so.$(version)
	ln -sf $(1).so.$(version) $(DESTDIR)$(LIBDIR)/$(1).so.$(major)
	ln -sf $(1).so.$(major) $(DESTDIR)$(LIBDIR)/$(1).so
	$(fill_in) $(wildcard src/$(1:lib%=%).pc.in src/*/$(1:lib%=%).pc.in) > $(DESTDIR)$(LIBDIR)/pkgconfig/$(1:lib%=%).pc

endef

deps-cluster: ## what check-cluster needs as well (Debian; Spark by pip)
	@BUILD=$(BUILD) sh tools/deps.sh cluster

install: all ## into $(DESTDIR)$(PREFIX)
	install -d $(DESTDIR)$(BINDIR) $(DESTDIR)$(LIBDIR)/pkgconfig $(DESTDIR)$(INCLUDEDIR) \
	  $(DESTDIR)$(MANDIR)/man1 $(DESTDIR)$(MANDIR)/man3 $(DESTDIR)$(MANDIR)/man7 $(DESTDIR)$(PREFIX)/share/cylint
	install -m 755 $(BUILD)/cylint $(DESTDIR)$(BINDIR)
	$(fill_in) tools/convert/cylint-convert > $(DESTDIR)$(BINDIR)/cylint-convert
	chmod 755 $(DESTDIR)$(BINDIR)/cylint-convert
	install -m 644 tools/convert/*.awk tools/render/autumn.awk $(DESTDIR)$(PREFIX)/share/cylint
	$(foreach l,$(libraries),$(call install_library,$(l)))
	install -m 644 $(patsubst %,include/%,cylint.h cylint_methods.h cylint_scene.h $(if $(EMBREE),cylint_embree.h)) $(DESTDIR)$(INCLUDEDIR)
	$(if $(PNG),install -m 755 $(BUILD)/cylint-render $(DESTDIR)$(BINDIR))
	for m in man/*.1; do install -m 644 $$m $(DESTDIR)$(MANDIR)/man1; done
	for m in man/*.3; do install -m 644 $$m $(DESTDIR)$(MANDIR)/man3; done
	for m in man/*.7; do install -m 644 $$m $(DESTDIR)$(MANDIR)/man7; done

uninstall: ## what install put there
	rm -f $(patsubst %,$(DESTDIR)$(BINDIR)/%,cylint cylint-convert cylint-render) $(patsubst include/%,$(DESTDIR)$(INCLUDEDIR)/%,$(wildcard include/*.h)) \
	  $(foreach l,libcylint libcylint-scene libcylint-embree,$(DESTDIR)$(LIBDIR)/$(l).* $(DESTDIR)$(LIBDIR)/pkgconfig/$(l:lib%=%).pc) \
	  $(DESTDIR)$(MANDIR)/man[137]/cylint*
	rm -rf $(DESTDIR)$(PREFIX)/share/cylint

clean: ## what was built
	rm -rf $(BUILD)

help: ## this list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/\1	\2/p' Makefile

.PHONY: all bench bench-text bench_programs demo stress search covered coverage mutants check check-cross check-cluster check-embree check-embree4 prove lint sanitize deps deps-cross deps-cluster install uninstall clean help
.SECONDARY:
%.d: ;
-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
