#!/bin/sh
# The Python package.  Its source distribution stands alone: it has the library's
# sources, and make finds all of them there.  A wheel is made of it elsewhere, with
# the libraries that make has built of the same sources, and installed into the
# environment that `make deps` makes; then pytest runs tests/python and the examples
# of the docstrings and of tools/python/README.md, and convert.txt is run.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
home=$build/python # the environment, and what is built
python=$home/bin/python

[ -x "$python" ] || skip_all 'no environment of Python (make deps)'

make_sdist()
{
    rm -rf "$home/dist"
    (cd tools/python && quiet "$python" -c "
import sys, scikit_build_core.build as backend
backend.build_sdist(sys.argv[1])" "$home/dist") &&
        tar -xzf "$home"/dist/*.tar.gz -C "$scratch"
}

stands_alone()
{
    sources=$(echo "$scratch"/libcylint-*/sources)
    (cd "$sources" && find . -type f -exec cmp {} "$top/{}" \;) > "$scratch/log" 2>&1
    [ ! -s "$scratch/log" ] || { cat "$scratch/log"; return 1; }
    quiet env -u MAKEFLAGS -u MAKELEVEL "${MAKE:-make}" -n -C "$sources" BUILD="$scratch/none" \
        "$scratch/none/libcylint.a" "$scratch/none/libcylint-scene.a" "$scratch/none/tools/cylint.a" &&
        [ "$(grep -c "^echo 'CC src/" "$scratch/log")" -gt 50 ]
}

# Builds again only if the sources changed; a clone's Makefile is out of reach.  -O1
# compiles the module in less time, as it does the tests in C.
make_wheel()
{
    sum=$({ gzip -dc "$home"/dist/*.tar.gz; cat "$build"/libcylint*.a "$build/tools/cylint.a"; } | cksum)
    [ "$sum" = "$(cat "$home/wheel/sum" 2>/dev/null)" ] && return
    rm -rf "$home/wheel"
    mkdir "$home/wheel" && (
        cd "$scratch" &&
            quiet env -u CFLAGS -u CXXFLAGS -u MAKEFLAGS -u MAKELEVEL -u BUILD \
                "$python" -m pip wheel --no-build-isolation --no-deps --no-index \
                --config-settings cmake.define.MAKE=true \
                --config-settings cmake.define.CYLINT_BUILD="$build" \
                --config-settings 'cmake.define.CMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG' \
                -w "$home/wheel" "$home"/dist/*.tar.gz
    ) && echo "$sum" > "$home/wheel/sum"
}

run_pytest()
{
    (cd "$home" && CYLINT_COMMAND=$build/cylint PYTHONDONTWRITEBYTECODE=1 \
        "$python" -m pytest -q -p no:cacheprovider "$top/tests/python") \
        > "$scratch/pytest" 2>&1
    status=$?
    # nanobind prints what it leaks at exit after pytest's last line
    sums=$(grep -E '^[0-9]+ [a-z]+(, .*)? in [0-9.]+s' "$scratch/pytest")
    passed_here=$(echo "$sums" | sed -n 's/^.*\b\([0-9][0-9]*\) passed.*/\1/p')
    failed_here=$(echo "$sums" | sed -n 's/^.*\b\([0-9][0-9]*\) \(failed\|error\).*/\1/p')
    passed=$((passed + ${passed_here:-0}))
    failed=$((failed + ${failed_here:-0}))
    [ $status -eq 0 ] && [ "${passed_here:-0}" -gt 50 ] ||
        { cat "$scratch/pytest"; false; }
    verdict pytest_ran_the_tests_and_examples $?
    ! grep -A 9 '^nanobind: leaked' "$scratch/pytest"
    verdict no_instance_of_the_module_is_left_at_exit $?
}

make_sdist
verdict the_source_distribution_is_made $? || { check_end; exit; }
stands_alone
verdict the_source_distribution_stands_alone $?
make_wheel
verdict a_wheel_is_made_of_it_elsewhere $? || { check_end; exit; }
quiet "$python" -m pip install --no-deps --no-index --force-reinstall "$home"/wheel/*.whl
verdict the_wheel_is_installed $? || { check_end; exit; }
run_pytest
PATH=$home/bin:$PATH
run_transcripts convert.txt < tests/python/convert.txt
check_end
