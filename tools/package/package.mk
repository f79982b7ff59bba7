# tools/package/package.mk: how the project is packed for those who link to it.

# ---------------------------------------------------------- amalgamation --
amalgamated := $(patsubst $(BUILD)/%.o,%.c,$(filter-out $(isa_builds:%=$(BUILD)/%.o),$(library_objects) $(scene_objects)))
one_file    := $(BUILD)/amalgamation/cylint.c
one_headers := include/cylint.h $(patsubst %,include/cylint_%.h,distance methods pieces scene)
isa_options  = $(filter-out -Wa$(comma)%,$(isa.$(1)))
comma       := ,
$(one_file): tools/package/amalgamate.py $(wildcard src/*.[ch] src/*/*.[ch]) $(one_headers) LICENSE
	@mkdir -p $(@D)
	$(call say,AMALGAMATE $@)cp $(one_headers) $(@D) && \
	  python3 $< '$(CC)' $@ $(version) $(amalgamated) $(foreach b,$(filter-out src/embree/% tests/%,$(isa_builds)),'$b=$(call isa_options,$b)')

amalgamation: $(one_file) ## write libcylint and libcylint-scene as one C file to $(BUILD)/amalgamation

# The libraries and the tests, with this object for those of src/.  test_arena
# puts its own functions in the place of exact.c's, which one object cannot;
# test_amalgamation.sh writes the file itself; test_install.sh tests which
# library exports what.
check-amalgamation: $(one_file) ## run every test with that file for the library
	$(MAKE) BUILD=$(BUILD)/amalgamated $(foreach o,library_objects scene_objects,$o='$(abspath $(one_file:.c=.o))') \
	  left_out='$(BUILD)/amalgamated/tests/bounds/test_arena tests/package/test_amalgamation.sh tests/package/test_install.sh' check

%/amalgamation/cylint.o: %/amalgamation/cylint.c
	$(call say,CC $<)$(CC) $(CPPFLAGS) $(CFLAGS) $(threads) $(hidden) -c -o $@ $<

# ---------------------------------------------- tarball, Debian, CMake --
tarball = $(BUILD)/cylint-$(version).tar.gz
dist: ## write the committed sources to $(BUILD)/cylint-VERSION.tar.gz
	@mkdir -p $(BUILD)
	$(call say,DIST $(tarball))git archive --format=tar --prefix=cylint-$(version)/ HEAD > $(tarball:.gz=) && gzip -f -n -9 $(tarball:.gz=)

deb: dist ## build Debian packages of the committed sources and run lintian
	sh tools/package/deb.sh $(tarball) $(version) $(BUILD)/deb

PYTHON ?= python3
wheel: ## write wheels for Linux (manylinux, musllinux) and the source distribution to $(BUILD)/wheels; PYTHON=python3.12
	sh tools/package/wheel.sh $(PYTHON) $(BUILD)/wheels

cmake_files = $(addprefix $(DESTDIR)$(LIBDIR)/cmake/cylint/,cylint-config.cmake cylint-config-version.cmake)
install: install-cmake
install-cmake: install-folders
	$(quietly)$(foreach f,$(cmake_files),$(fill_in) tools/package/cmake/$(notdir $f).in > $f &&) true

uninstall: uninstall-cmake
uninstall-cmake:
	rm -f $(cmake_files)

.PHONY: amalgamation check-amalgamation dist deb wheel install-cmake uninstall-cmake
