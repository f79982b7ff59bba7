#!/bin/sh
# The tests of scene and embree on Embree 4, if embree4/fetch.sh gets it.
here=$(dirname "$0")
. "$here/../support/verdict.sh"
. "$here/../support/installs.sh"
folder=$build/embree4
library=$(sh "$here/embree4/fetch.sh" "$folder/wheel")
status=$?
[ $status -eq 0 ] || { echo "$library"; exit $status; }
sh "$here/embree4/headers.sh" "$folder/include" || exit
library=$(cd "$(dirname "$library")" && pwd)/$(basename "$library")
# What does not include a header of Embree is the same and is not compiled again; in
# src/embree this is float_filter.c, of which make -o keeps the objects.
mkdir -p "$folder/src" "$folder/tests" &&
    cp -pr "$build/src/." "$folder/src" &&
    cp -pr "$build/tests/support" "$build/tests/distance" "$folder/tests"
make_with_4()
{
    make -s -C "$top" $(printf -- '-o %s ' "$folder"/src/embree/float_filter*.o) \
        BUILD="$folder" EMBREE=4 \
        EMBREE_CFLAGS="-I$folder/include -Werror=implicit-function-declaration -Werror=pedantic" \
        EMBREE_LIBS="$library -Wl,-rpath,$(dirname "$library")" "$@"
}

# The program of cylint_embree(3), with the three changes that the page names.
display cylint_embree.3 1 | sed 's/embree3/embree4/
    /^ *struct RTCIntersectContext/d; /^ *rtcInitIntersectContext/d
    s/rtcIntersect1(.*/rtcIntersect1(scene, \&at, NULL);/' > "$scratch/example.c"
display cylint_embree.3 2 > "$scratch/said"
make_with_4 "$folder/libcylint-embree4.a" "$folder/libcylint.a" &&
    $cc -std=c99 -Werror -Iinclude -I"$folder/include" -o "$scratch/example" \
        "$scratch/example.c" "$folder/libcylint-embree4.a" \
        "$folder/libcylint.a" "$library" -Wl,-rpath,"$(dirname "$library")" \
        -pthread -lm &&
    "$scratch/example" | diff "$scratch/said" - || {
    echo 'FAILED the program of cylint_embree(3)'
    exit 1
}
# test_float_filter and test_embree_float_bounds do not use Embree.
make_with_4 left_out="$folder/tests/embree/test_float_filter $folder/tests/bounds/test_embree_float_bounds" \
    check-embree
