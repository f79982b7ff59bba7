# tests/tests.mk: how the tests are built and run; the Makefile includes it.

# -O1 compiles a test in half the time of -O2, and most of its running time is the
# library's.
$(BUILD)/tests/%: extra := $(if $(filter -O2 -O3,$(CFLAGS)),-O1) $(floats) $(posix) $(static) -Isrc -Itests/support \
	$(if $(MPFR),-DHAVE_MPFR) $(if $(WRAP),-DWRAPPED)
$(BUILD)/tests/embree/% $(BUILD)/tests/bounds/%: extra += $(embree)

# A test stands in the folder of its subject: tests/README.md.
$(foreach f,$(wildcard tests/test_*),$(error $f belongs into a folder of tests/))
test_common   := $(patsubst %,$(BUILD)/tests/%.o,$(addprefix support/,families family_records) \
                 $(if $(MPFR),support/oracle distance/distance_oracle distance/distance_oracle_elliptic))
test_libs     := $(if $(MPFR),-lmpfr -lgmp)
# The signs of test_arena are random, so the second decision of PARANOID=1 contradicts.
test_programs := $(filter-out $(left_out) $(if $(PARANOID),$(BUILD)/tests/bounds/test_arena),$(patsubst %.c,$(BUILD)/%,$(wildcard tests/*/test_*.c)))
scene_tests   := $(filter $(addprefix $(BUILD)/tests/,scene/% bvh/% bounds/test_scene%),$(test_programs))
embree_tests  := $(filter $(addprefix $(BUILD)/tests/,embree/% bounds/test_embree%),$(test_programs))
test_programs := $(if $(EMBREE),$(test_programs),$(filter-out $(embree_tests),$(test_programs)))
test_scripts  := $(filter-out $(left_out),$(wildcard tests/*/test_*.sh))

# ---------------------------------------------------- tests in C, by floor --

# Long runs, which `make check` leaves out, are built as the tests are.
core_tests := $(filter-out $(scene_tests) $(embree_tests),$(test_programs)) \
              $(patsubst %,$(BUILD)/tests/%,package/records package/answers)
$(core_tests): %: %.o $(test_common) $(BUILD)/libcylint.a
$(scene_tests): %: %.o $(BUILD)/tests/support/scenes.o $(test_common) $(scene_library)
$(embree_tests): %: %.o $(BUILD)/tests/support/scenes.o $(test_common) \
	$(call archive,$(adapter)) $(BUILD)/libcylint.a
$(BUILD)/tests/command/pixels: $(BUILD)/tests/command/pixels.o $(scene_library)

$(core_tests) $(scene_tests): libs := $(test_libs) $(threads_link)
$(embree_tests): libs := $(EMBREE_LIBS) $(test_libs) $(threads_link)
$(BUILD)/tests/command/pixels: libs := -lpng $(threads_link)

# Without MPFR these programs only say so.
needs_mpfr := $(addprefix $(BUILD)/tests/,bounds/test_member_bounds distance/test_oracle filter/test_local_coordinates \
              library/test_intersect numbers/test_exact numbers/test_turns shapes/test_errors)
$(if $(MPFR),,$(needs_mpfr:%=%.o)): $(BUILD)/tests/%.o: tests/support/no_mpfr.c $$(@D)/flags
	$(call say,CC $<)$(compile) -c -o $@ $<

# --wrap: calls of these functions go to __wrap_ functions of a test.
wrap = $(foreach c,$(1),-Wl,--wrap=$c)
$(BUILD)/tests/scene/test_memory: wrapped := $(if $(WRAP),$(call wrap,malloc calloc realloc free pthread_create))
$(BUILD)/tests/embree/test_shapes: wrapped := $(if $(WRAP),$(call wrap,pthread_create rtcGetDeviceProperty rtcNewGeometry))

$(core_tests) $(scene_tests) $(embree_tests) $(BUILD)/tests/command/pixels:
	$(link)

# The command, with system calls that fail as tests/command/faults.c says.
$(BUILD)/tests/command/faulty: $(BUILD)/tests/command/faults.o $(tool_objects) $(scene_library)
$(BUILD)/tests/command/faulty: wrapped := $(call wrap,read write poll open close fsync rename \
	malloc calloc realloc free pipe pthread_create)

# A target of tests/fuzz runs under libFuzzer (FUZZER=yes, by `make fuzz`) or
# replays files; read() and write() of the fuzzed command are the test's.
fuzz_programs := $(patsubst %,$(BUILD)/tests/fuzz/%,record command shapes $(if $(FUZZER),scene_file))
$(BUILD)/tests/fuzz/main.o: tools/cylint/main.c $(BUILD)/tests/fuzz/flags
	$(call say,CC $<)$(compile) -Dmain=command_main -c -o $@ $<
$(fuzz_programs): %: %.o $(BUILD)/tests/fuzz/main.o $(if $(FUZZER),,$(BUILD)/tests/fuzz/replay.o) \
	$(filter-out %/main.o,$(tool_objects)) $(scene_library)
$(BUILD)/tests/fuzz/scene_file: $(BUILD)/tests/support/scenes.o
$(BUILD)/tests/fuzz/shapes: $(if $(MPFR),$(BUILD)/tests/support/oracle.o)
$(BUILD)/tests/fuzz/shapes $(BUILD)/tests/fuzz/scene_file: $(BUILD)/tests/support/family_records.o
$(fuzz_programs): libs := $(if $(FUZZER),-fsanitize=fuzzer) $(test_libs)
$(BUILD)/tests/fuzz/command: wrapped := $(call wrap,open read write close)

$(BUILD)/tests/command/faulty $(fuzz_programs): linker = $(with_numbers) -pthread
$(BUILD)/tests/command/faulty $(fuzz_programs):
	$(link)

# ----------------------------------------------------------------- check --

deps: deps-debian ## install what the tests need (Debian; Python's packages by pip)
	@BUILD=$(BUILD) sh tools/deps.sh

deps-debian:
	@sh tools/deps.sh debian

deps-cross deps-cluster: deps
deps-cross: ## what check-cross and lint need as well (Debian)
	@BUILD=$(BUILD) sh tools/deps.sh cross

deps-cluster: ## what check-cluster needs as well (Debian; Spark by pip)
	@BUILD=$(BUILD) sh tools/deps.sh cluster

# $(call run_tests,TEST...): each is a target of run.mk; the long ones start first.
# MISSING: what `make deps` installs and was not found, unless the user said so
long_tests = $(addprefix tests/,package/test_amalgamation.sh python/test_python.sh embree/test_embree4.sh command/test_faults.sh package/test_build.sh package/test_packages.sh package/test_install.sh) \
             $(addprefix $(BUILD)/tests/,library/test_batch scene/test_queries distance/test_oracle embree/test_random)
missing    = $(if $($(1))$(filter-out file undefined,$(origin $(1))),,$(2))
run_tests  = +@TESTS='$(filter $(1),$(long_tests)) $(filter-out $(long_tests),$(1))' \
	BUILD=$(BUILD) CC='$(CC)' CXX='$(CXX)' CXX17='$(CXX17)' PARANOID='$(PARANOID)' \
	MISSING='$(call missing,MPFR,MPFR) $(call missing,EMBREE,Embree) $(call missing,PNG,libpng) $(call missing,CXX17,C++17)' \
	$(MAKE) --no-print-directory -f tests/support/run.mk

check: all $(BUILD)/tools/cylint.a $(if $(POSIX),$(BUILD)/demo/cylint) $(test_programs) $(if $(WRAP),$(BUILD)/tests/command/faulty $(fuzz_programs)) $(if $(PNG),$(BUILD)/tests/command/pixels) $(filter deps,$(MAKECMDGOALS)) ## run every test (PARANOID=1: each decision twice)
	$(call run_tests,$(test_programs) $(test_scripts))

check-embree: $(if $(EMBREE),$(embree_tests)) ## run the tests that need Embree, with the installed one
	@$(if $(EMBREE),,echo 'check-embree: no Embree (make deps)'; exit 1)
	$(call run_tests,$(embree_tests))

check-embree4: all ## the same with Embree 4, downloaded from PyPI
	$(call run_tests,tests/embree/test_embree4.sh)

check-scene: $(BUILD)/tests/scene/test_queries ## compare scenes with brute force, about two minutes
	CYLINT_CASES=1000 $<

check-cross: $(BUILD)/tests/package/records ## compare the bytes from other compilers and processors
	@BUILD=$(BUILD) sh tests/package/cross.sh

check-cluster: all ## run the recipes of cylint(7) for GNU parallel, Slurm and Spark
	@BUILD=$(BUILD) sh tests/package/cluster/check.sh

# ------------------------------------------------ sanitizers and fuzzing --

sanitized := -fsanitize=address,undefined -fno-sanitize-recover=all
sanitize: ## run the tests under the address and undefined-behaviour sanitizers
	$(MAKE) BUILD=$(BUILD)/sanitize check \
	  left_out='$(wildcard tests/package/test_*.sh) tests/python/test_python.sh tests/embree/test_embree4.sh' \
	  CFLAGS='-g -O1 $(sanitized)' CXXFLAGS='-g -O1 $(sanitized)'

sanitize-python: $(BUILD)/cylint ## run the Python package's tests under the sanitizers
	@BUILD=$(BUILD) CC='$(CC)' sh tests/python/sanitize.sh

threaded := -g -O1 -fsanitize=thread
thread_tests := $(BUILD)/cylint $(BUILD)/tests/command/faulty $(BUILD)/tests/bvh/test_nodes $(BUILD)/tests/scene/test_many \
	$(if $(EMBREE),$(BUILD)/tests/embree/test_threads) $(if $(PNG),$(BUILD)/cylint-render)
thread_tests: $(thread_tests)
check-threads: ## run scenes of several threads, 8 workers, under the thread sanitizer
	$(MAKE) BUILD=$(BUILD)/threads CFLAGS='$(threaded)' CXXFLAGS='$(threaded)' thread_tests
	TSAN_OPTIONS=exitcode=66 $(BUILD)/threads/tests/bvh/test_nodes
	TSAN_OPTIONS=exitcode=66 $(BUILD)/threads/tests/scene/test_many
	$(if $(EMBREE),TSAN_OPTIONS=exitcode=66 $(BUILD)/threads/tests/embree/test_threads)
	BUILD=$(BUILD)/threads WORKERS=8 sh tests/command/test_faults.sh
	$(if $(PNG),BUILD=$(BUILD)/threads sh tests/command/render_threads.sh)

fuzzed := -fsanitize=fuzzer-no-link -fno-sanitize-coverage=trace-cmp $(sanitized)
fuzz_programs: $(if $(WRAP),$(fuzz_programs))
	@$(if $(WRAP),,echo 'fuzz: $(CC) does not link with its sanitizers (Debian: libclang-rt-VERSION-dev)'; exit 1)
fuzz: ## run libFuzzer on tests/fuzz; SECONDS=60 each (needs clang)
	$(MAKE) -s BUILD=$(BUILD)/fuzz FUZZER=yes PARANOID=1 CC=clang CXX=clang++ \
	  CPPFLAGS=-DCYLINT_SHRINK=1024 CFLAGS='-g -O1 $(fuzzed)' \
	  CXXFLAGS='-g -O1 $(fuzzed)' fuzz_programs
	@BUILD=$(BUILD)/fuzz SECONDS=$(or $(SECONDS),60) sh tests/fuzz/fuzz.sh

# ----------------------------------------------- proofs, coverage, looks --

prove: ## prove the error bounds by Gappa; 1 % less must not be provable
	@BUILD=$(BUILD) CC='$(CC)' sh tests/bounds/prove/prove.sh

lint: all ## static analysis, the ladder of floors, the format of sources
	@BUILD=$(BUILD) CC='$(CC)' sh tests/support/lint.sh

covered: all $(test_programs)
	$(call run_tests,$(test_programs))

# Counters that threads share are wrong, even negative, unless they are atomic.
counting := -g -O0 --coverage -fprofile-update=atomic -fno-math-errno
coverage: ## branches of src/ that no test takes, without a reason beside them
	rm -rf $(BUILD)/coverage
	$(MAKE) BUILD=$(BUILD)/coverage vectors= small= CFLAGS='$(counting)' CXXFLAGS='$(counting)' covered
	python3 tests/support/coverage.py $(BUILD)/coverage

mutants: ## change operators and constants, and list changes that pass; COUNT=20 a file
	python3 tests/support/mutants.py --cc '$(CC)' --count $(or $(COUNT),20)

stress: $(BUILD)/tests/library/test_intersect ## compare 1e8 cases with the oracle, two seeds side by side, up to an hour
	@for seed in 20240 20241; do \
	  CYLINT_CASES=1000000 CYLINT_SEED=$$seed $< & jobs="$$jobs $$!"; done; \
	  for job in $$jobs; do wait $$job || exit; done

.PHONY: deps deps-debian deps-cross deps-cluster check check-embree check-embree4 check-scene check-cross check-cluster check-threads \
	thread_tests sanitize sanitize-python fuzz fuzz_programs prove lint covered coverage mutants stress
