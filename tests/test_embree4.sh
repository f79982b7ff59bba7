#!/bin/sh
# Floors scene and embree: their tests on Embree 4, if tests/embree4/fetch.sh gets
# it.  EMBREE4=no skips them without a download.
here=$(dirname "$0")
build=${BUILD:-build}
folder=$build/embree4
[ "$EMBREE4" = no ] && { echo 'EMBREE4=no'; exit 77; }
library=$(sh "$here/embree4/fetch.sh" "$folder/wheel")
status=$?
[ $status -eq 0 ] || { echo "$library"; exit $status; }
library=$(cd "$(dirname "$library")" && pwd)/$(basename "$library")
# libcylint is the same, so its objects are not compiled again
mkdir -p "$folder/src" &&
    cp -pr "$build/src/." "$folder/src" &&
    rm -rf "$folder/src/scene" "$folder/src/embree" "$folder/src/bvh" &&
    make -s -C "$here/.." BUILD="$folder" EMBREE=4 \
        EMBREE_CFLAGS='-Itests/embree4 -Werror=implicit-function-declaration' \
        EMBREE_LIBS="$library -Wl,-rpath,$(dirname "$library")" check-embree
