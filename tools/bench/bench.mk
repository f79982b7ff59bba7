# tools/bench/bench.mk: the benchmarks; the Makefile includes it.

$(BUILD)/tools/bench/%: extra := $(floats) $(posix) $(static) -Isrc -Itests/support -Itools/bench -Itools/bench/rivals $(embree) \
	$(if $(MPFR),-DHAVE_MPFR) $(if $(GSL),-DHAVE_GSL)
bench_objects = $(patsubst %,$(BUILD)/tools/bench/%.o,$(1))

# The program of all cases in C: `bench CASE...`.
bench := $(BUILD)/tools/bench/bench
$(bench): $(call bench_objects,bench inputs sticks single batch distance methods scene pieces rivals/lean rivals/lean_distance \
	$(if $(EMBREE),embree rivals/embree_chords)) $(test_common) \
	$(if $(EMBREE),$(BUILD)/libcylint-embree.a $(BUILD)/libcylint.a,$(scene_library))
$(bench): libs := $(EMBREE_LIBS) $(test_libs) $(threads_link)
$(BUILD)/tools/bench/stages: $(BUILD)/tools/bench/stages.o $(test_common) $(BUILD)/libcylint.a
$(BUILD)/tools/bench/stages: libs := $(test_libs)
$(BUILD)/tools/bench/python_scene: $(BUILD)/tools/bench/python_scene.o $(scene_library)
$(BUILD)/tools/bench/python_scene: libs := $(threads_link)
$(BUILD)/tools/bench/measure: $(BUILD)/tools/bench/measure.o
$(bench) $(patsubst %,$(BUILD)/tools/bench/%,stages python_scene measure):
	$(link)

# $(call run_bench,CASE...): the lines of output are also in $(BUILD)/bench-CASE.csv
# N: the most shapes of a scene; ONLY: subjects that contain it
run_bench = @$(foreach c,$(1),TMPDIR=$(BUILD) $(bench) $(if $(QUICK),-s 0.02 -n 1e5) $(if $(N),-n $(N)) $(if $(ONLY),-o '$(ONLY)') $c | tee $(BUILD)/bench-$c.csv;)

bench: $(bench) ## one line or point, one shape; batches; time against error; QUICK=1: in a minute
	$(call run_bench,single batch distance methods)

bench-scene: $(bench) ## queries of scenes; build, move, save and open; QUICK=1; N=1e7 shapes
	$(call run_bench,scene)

bench-pieces: $(bench) ## pieces of a line, beside what callers do without them; QUICK=1
	$(call run_bench,pieces)

bench-embree: $(bench) ## scenes of Embree, beside its own curves; QUICK=1
	@$(if $(EMBREE),,echo 'bench-embree: no Embree (make deps)'; exit 1)
	$(call run_bench,embree)

gate: $(bench) $(BUILD)/tests/package/records $(BUILD)/tests/package/answers ## answers and times beside those of COMMIT=...
	@BUILD='$(BUILD)' sh tools/bench/gate.sh

bench-text: $(commands) $(BUILD)/tools/bench/measure ## time of the command and of programs that read numbers; QUICK=1
	@BUILD='$(BUILD)' QUICK='$(QUICK)' sh tools/bench/text.sh

# $(call rivals_of,PACKAGE...): they have an environment of their own; the wheel is that
# of the tests.
rivals := $(BUILD)/rivals
define rivals_of
@BUILD=$(BUILD) sh tests/python/test_python.sh
@[ -x $(rivals)/bin/python ] || python3 -m venv $(rivals)
@$(rivals)/bin/pip install -q numpy $(1)
@$(rivals)/bin/pip install -q --no-deps --force-reinstall $(BUILD)/python/wheel/*.whl
endef
bench-python: $(BUILD)/tools/bench/python_scene $(BUILD)/cylint ## time of the Python package and of its rivals, fetched by pip
	$(call rivals_of,scikit-spatial trimesh embreex rtree vtk open3d itk-rtk)
	$(rivals)/bin/python tools/bench/python_rays.py $(BUILD)/tools/bench/python_scene $(rivals)/input
	$(rivals)/bin/python tools/bench/python_distance.py $(BUILD)/tools/bench/python_scene $(rivals)/input
	$(rivals)/bin/python tools/bench/python_sums.py

# The version of a wheel whose objects python_geant4.py can read.
$(call bench_objects,geant4 timing): extra += -fPIC
$(BUILD)/tools/bench/geant4.so: $(call bench_objects,geant4 timing) $(BUILD)/libcylint.a
	$(call say,LD $@)$(CC) $(CFLAGS) $(LDFLAGS) -shared -o $@ $^ -lm
bench-geant4: $(BUILD)/tools/bench/geant4.so $(BUILD)/cylint ## hollow solids and sectors beside Geant4, fetched by pip; RAYS=4000
	$(call rivals_of,geant4-pybind==0.1.3)
	$(rivals)/bin/python tools/bench/python_geant4.py $< $(RAYS)

# A library that counts the stages of queries.
count_stages: $(BUILD)/tools/bench/stages
	$< $(CASES)
stages: ## share of queries that reach each stage (pairs, exact digits), by family
	$(MAKE) -s BUILD=$(BUILD)/stages CPPFLAGS='$(CPPFLAGS) -DCYLINT_COUNT_STAGES' count_stages

.PHONY: bench gate bench-scene bench-pieces bench-text bench-embree bench-python bench-geant4 stages count_stages
