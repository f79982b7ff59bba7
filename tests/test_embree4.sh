#!/bin/sh
# The tests of the adapter and of scenes once more, on Embree 4, where it can
# be had (tests/embree4/fetch.sh).  EMBREE4=no: not even asked for.
here=$(dirname "$0")
build=${BUILD:-build}
folder=$build/embree4
[ "$EMBREE4" = no ] && { echo 'EMBREE4=no'; exit 77; }
library=$(sh "$here/embree4/fetch.sh" "$folder/wheel")
status=$?
[ $status -eq 0 ] || { echo "$library"; exit $status; }
library=$(cd "$(dirname "$library")" && pwd)/$(basename "$library")
# the library proper is the same: its objects need not be compiled again
mkdir -p "$folder/src" &&
    cp -pr "$build/src/." "$folder/src" &&
    rm -rf "$folder/src/scene" "$folder/src/embree" "$folder/src/bvh" &&
    make -s -C "$here/.." BUILD="$folder" EMBREE=4 \
        EMBREE_CFLAGS='-Itests/embree4 -Werror=implicit-function-declaration' \
        EMBREE_LIBS="$library -Wl,-rpath,$(dirname "$library")" check-embree
