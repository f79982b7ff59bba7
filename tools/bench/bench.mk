# tools/bench/bench.mk: the benchmarks; the Makefile includes it.

$(BUILD)/tools/bench/%: extra := $(floats) $(posix) $(static) -Isrc -Itests/support -Itools/bench -Itools/bench/rivals $(embree) \
	$(if $(MPFR),-DHAVE_MPFR)
bench_objects = $(patsubst %,$(BUILD)/tools/bench/%.o,$(1))

# The program of all cases in C: `bench CASE...`.
bench := $(BUILD)/tools/bench/bench
$(bench): $(call bench_objects,bench inputs single batch distance methods scene pieces calls rivals/lean \
	$(if $(findstring COUNT_STAGES,$(CPPFLAGS)),stages) $(if $(EMBREE),embree rivals/embree_chords)) $(test_common) \
	$(if $(EMBREE),$(call archive,$(adapter)) $(BUILD)/libcylint.a,$(scene_library))
$(bench): libs := $(EMBREE_LIBS) $(test_libs) $(threads_link)
$(bench):
	$(link)

# $(call to_csv,CASE,COMMAND): the lines of output are also in $(BUILD)/bench-CASE.csv.
# The status is that of the command, not of tee.
to_csv = { $(2); echo $$? >$(BUILD)/bench-$(1).status; } | tee $(BUILD)/bench-$(1).csv; exit $$(cat $(BUILD)/bench-$(1).status)

# $(call run_bench,CASE...).  N: the most shapes of a scene; ONLY: subjects that contain it.
# A case without one, status 4, is an error if all are.
run_bench = @status=4; for c in $(1); do ($(call to_csv,$$c,TMPDIR=$(BUILD) $(bench) $(if $(QUICK),-s 0.02 -n 1e5) $(if $(N),-n $(N)) $(if $(ONLY),-o '$(ONLY)') $$c)); \
  case $$? in 0) status=0 ;; 4) ;; *) exit 3 ;; esac; done; exit $$status

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

# $(call rivals_of,PACKAGE...): an environment with them and the package of this tree
rivals := $(BUILD)/rivals
rivals_of = @$(rivals)/bin/pip install -q $(1)
$(rivals)/package: $(scene_library) $(wildcard tools/python/src/* tools/python/libcylint/*.py)
	$(call say,PIP $(rivals))python3 -m venv $(rivals)
	@$(rivals)/bin/pip install -q numpy
	@$(rivals)/bin/pip install -q --no-deps --force-reinstall --config-settings cmake.define.CYLINT_BUILD=$(abspath $(BUILD)) ./tools/python
	@touch $@
quick := $(if $(QUICK),--quick)
bench-text: $(BUILD)/cylint $(rivals)/package ## the command beside polars, fetched by pip, and mawk; QUICK=1
	$(call rivals_of,polars)
	@$(call to_csv,text,$(rivals)/bin/python tools/bench/text.py $< $(quick))

bench-python: $(rivals)/package ## the Python package beside Open3D, fetched by pip; QUICK=1
	$(call rivals_of,trimesh open3d)
	@$(call to_csv,python,$(rivals)/bin/python tools/bench/python.py $(quick))

# geant4.py can read the objects of this version of the wheel.
$(BUILD)/tools/bench/rivals/geant4.o: extra += -fPIC
$(BUILD)/tools/bench/geant4.so: $(BUILD)/tools/bench/rivals/geant4.o $(BUILD)/libcylint.a
	$(call say,LD $@)$(CC) $(CFLAGS) $(LDFLAGS) -shared -o $@ $^ -lm
bench-geant4: $(BUILD)/tools/bench/geant4.so $(rivals)/package ## hollow solids and sectors beside Geant4, fetched by pip; RAYS=4000
	$(call rivals_of,geant4-pybind==0.1.3)
	@$(call to_csv,geant4,$(rivals)/bin/python tools/bench/geant4.py $< $(or $(RAYS),$(if $(QUICK),400)))

# With a library that counts the stages of queries.
bench-stages: $(bench)
	$(call run_bench,stages)
stages: ## share of queries that reach each stage (pairs, exact digits), by family; QUICK=1; N=1e4 queries
	$(MAKE) -s BUILD=$(BUILD)/stages EMBREE= CPPFLAGS='$(CPPFLAGS) -DCYLINT_COUNT_STAGES' bench-stages

.PHONY: bench gate bench-scene bench-pieces bench-embree bench-text bench-python bench-geant4 bench-stages stages
