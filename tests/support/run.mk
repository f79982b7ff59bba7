# run.mk: runs each of $TESTS as a target, so side by side under make's jobs, and
# prints a report of all.  They start in the order of $TESTS; a failure stops none.
#
#     TESTS='build/tests/library/test_hits tests/command/test_cli.sh' BUILD=build \
#         make -j2 -f tests/support/run.mk
runs := $(TESTS:=.run)

report: $(runs)
	@sh tests/support/run.sh report $(sort $(TESTS))

$(runs):
	@$(if $(findstring s,$(firstword -$(MAKEFLAGS))),,echo 'TEST $(@:.run=)';) \
	  sh tests/support/run.sh run $(@:.run=)

.PHONY: report $(runs)
