# tools/bench/bench.mk: the benchmarks; the Makefile includes it.

$(BUILD)/tools/bench/%: extra := $(floats) $(posix) $(static) -Isrc -Itests/support -Itools/bench -Itools/bench/rivals $(embree) \
	$(if $(MPFR),-DHAVE_MPFR) $(if $(GSL),-DHAVE_GSL)
bench_objects = $(patsubst %,$(BUILD)/tools/bench/%.o,$(1))

embree_programs := $(patsubst %,$(BUILD)/tools/bench/%,embree embree_round embree_many embree_packets embree_threads embree_counts)

# The program of all cases in C: `bench CASE...`.
bench := $(BUILD)/tools/bench/bench
$(bench): $(call bench_objects,bench inputs single batch distance methods rivals/lean rivals/lean_distance) \
	$(test_common) $(scene_library)
$(bench) $(BUILD)/tools/bench/stages: libs := $(test_libs) $(threads_link)
$(BUILD)/tools/bench/stages: $(BUILD)/tools/bench/stages.o $(test_common) $(BUILD)/libcylint.a

$(BUILD)/tools/bench/scene $(BUILD)/tools/bench/distance_scene: $(BUILD)/tests/support/scenes.o
$(patsubst %,$(BUILD)/tools/bench/%,distance_scene pieces): $(call bench_objects,timing)
$(BUILD)/tools/bench/pieces: $(if $(EMBREE),$(call bench_objects,embree_chords))
$(patsubst %,$(BUILD)/tools/bench/%,scene distance_scene python_scene large pieces): %: %.o $(scene_library)
$(patsubst %,$(BUILD)/tools/bench/%,scene distance_scene python_scene large pieces): libs := $(threads_link)
$(BUILD)/tools/bench/pieces: libs += $(EMBREE_LIBS)

$(patsubst %,$(BUILD)/tools/bench/%,embree embree_round embree_many embree_packets): $(call bench_objects,timing)
$(patsubst %,$(BUILD)/tools/bench/%,embree embree_round embree_many): $(call bench_objects,embree_race)
$(embree_programs): %: %.o $(call bench_objects,embree_scenes embree_rivals) \
	$(BUILD)/libcylint-embree.a $(BUILD)/libcylint.a
$(embree_programs): libs := $(EMBREE_LIBS) $(threads_link)
$(BUILD)/tools/bench/embree_counts: wrapped := $(call wrap,cylint_float_filter_of_one cylint_intersect)

$(BUILD)/tools/bench/measure: $(BUILD)/tools/bench/measure.o

$(bench) $(embree_programs) $(patsubst %,$(BUILD)/tools/bench/%,stages scene distance_scene python_scene large pieces measure):
	$(link)

# $(call run_bench,CASE...): the lines of output are also in $(BUILD)/bench-CASE.csv
run_bench = @$(foreach c,$(1),$(bench) $(if $(QUICK),-s 0.02) $(if $(N),-n $(N)) $c | tee $(BUILD)/bench-$c.csv;)

bench: $(bench) ## one line or point, one shape; batches; time against error; QUICK=1: in a minute
	$(call run_bench,single batch distance methods)

gate: $(bench) $(BUILD)/tests/package/records $(BUILD)/tests/package/answers ## answers and times beside those of COMMIT=...
	@BUILD='$(BUILD)' sh tools/bench/gate.sh

bench-scene: $(patsubst %,$(BUILD)/tools/bench/%,bench scene distance_scene) ## time of scenes and of batches of all shapes
	@BUILD='$(BUILD)' sh tools/bench/scene.sh

bench-pieces: $(BUILD)/tools/bench/pieces ## time of the pieces of a line, and of what callers do without them
	@$(BUILD)/tools/bench/pieces && $(BUILD)/tools/bench/pieces --sums

N ?= 10000000
KIND ?= thin
bench-large: $(BUILD)/tools/bench/large ## make, save and open a scene of N=... cylinders, KIND=thin, fat or fibres
	@$(BUILD)/tools/bench/large $(N) $(BUILD)/large.scene $(KIND) && rm -f $(BUILD)/large.scene

bench-text: $(commands) $(BUILD)/tools/bench/measure ## time of the command and of programs that read numbers; QUICK=1
	@BUILD='$(BUILD)' QUICK='$(QUICK)' sh tools/bench/text.sh

bench-saved: $(commands) $(BUILD)/tools/bench/measure ## time and memory of the command with scenes of text and saved ones
	@BUILD='$(BUILD)' sh tools/bench/saved.sh

bench-embree: $(filter-out %_counts,$(embree_programs)) ## time of scenes and of Embree's own curves; QUICK=1: in a minute
	$(BUILD)/tools/bench/embree $(if $(QUICK),0.5 1e5,5 1e7) | tee $(BUILD)/embree.tsv
	$(BUILD)/tools/bench/embree_round $(if $(QUICK),0.5 1e5,5 1e6) | tee $(BUILD)/embree-round.tsv
	$(BUILD)/tools/bench/embree_many $(if $(QUICK),0.5,5) | tee $(BUILD)/embree-many.tsv
	$(BUILD)/tools/bench/embree_packets $(if $(QUICK),0.5 1e5,5 1e7) | tee $(BUILD)/embree-packets.tsv
	$(BUILD)/tools/bench/embree_threads 2 $(if $(QUICK),1e5,1e6) | tee $(BUILD)/embree-threads.tsv
	@$(if $(WRAP),$(MAKE) -s BUILD=$(BUILD)/visits CPPFLAGS='$(CPPFLAGS) -DCYLINT_COUNT_VISITS' count_visits | tee $(BUILD)/embree-counts.tsv)

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

# An adapter that counts the nodes and leaves that a ray visits.
count_visits: $(BUILD)/tools/bench/embree_counts
	$< $(if $(QUICK),1e5,1e6)

# A library that counts the stages of queries.
count_stages: $(BUILD)/tools/bench/stages
	$< $(CASES)
stages: ## share of queries that reach each stage (pairs, exact digits), by family
	$(MAKE) -s BUILD=$(BUILD)/stages CPPFLAGS='$(CPPFLAGS) -DCYLINT_COUNT_STAGES' count_stages

.PHONY: bench gate bench-scene bench-pieces bench-large bench-text bench-saved bench-embree bench-python bench-geant4 count_visits stages count_stages
