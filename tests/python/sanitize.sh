#!/bin/sh
# Runs the tests of the Python package with the extension and the library under
# the address and undefined-behaviour sanitizers.  BUILD has the environment that
# `make deps` makes; the sanitized package goes to $BUILD/python/sanitized.
set -e
build=$(cd "${BUILD:-build}" && pwd)
python=$build/python/bin/python
cc=${CC:-gcc}
flags='-g -O1 -fsanitize=address,undefined -fno-sanitize-recover=undefined'
at=$build/python/sanitized

rm -rf "$at"
CFLAGS="$flags" CXXFLAGS="$flags" CC=$cc "$python" -m pip install -q \
    --no-build-isolation --no-deps --no-index --target "$at" \
    --config-settings build-dir="$build/python/sanitized-build" \
    --config-settings "cmake.define.CYLINT_MAKE_FLAGS=CFLAGS=$flags" ./tools/python
cd "$build/python"
# Python itself keeps memory to its end, so leaks are found by test_calls.py; its
# allocator hides errors from the sanitizer.  A test requests more memory than there
# is.  --capture=sys leaves the sanitizer its standard error.
PYTHONPATH=$at PYTHONMALLOC=malloc CYLINT_COMMAND=$build/cylint \
    LD_PRELOAD="$($cc -print-file-name=libasan.so) $($cc -print-file-name=libubsan.so)" \
    ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1 UBSAN_OPTIONS=print_stacktrace=1 \
    "$python" -m pytest -q --capture=sys -p no:cacheprovider "$OLDPWD/tests/python" \
    -k 'not memory_does_not_grow'
