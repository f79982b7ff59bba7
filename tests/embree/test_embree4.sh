#!/bin/sh
# The program of cylint_embree(3) with Embree 4; and the tests of scene and embree, if
# the build has Embree 3 and embree4/fetch.sh gets Embree 4.
here=$(dirname "$0")
. "$here/../support/verdict.sh"
. "$here/../support/installs.sh"

# The page names the three changes.
runs_example() # EMBREE4_LIBRARY BUILD [FLAG]...
{
    library=$1 libraries=$2
    shift 2
    display cylint_embree.3 1 | sed 's/embree3/embree4/
        /^ *struct RTCIntersectContext/d; /^ *rtcInitIntersectContext/d
        s/rtcIntersect1(.*/rtcIntersect1(scene, \&at, NULL);/' > "$scratch/example.c"
    display cylint_embree.3 2 > "$scratch/said"
    $cc -std=c99 -Werror -Iinclude "$@" -o "$scratch/example" "$scratch/example.c" \
        "$libraries/libcylint-embree4.a" "$libraries/libcylint.a" "$library" \
        -Wl,-rpath,"$(dirname -- "$library")" -pthread -lm &&
        "$scratch/example" | diff "$scratch/said" -
}

program='the program of cylint_embree(3)'
if grep -q '^EMBREE ?= 4$' "$build/config.mk"; then
    runs_example -lembree4 "$build"
    verdict "$program" $?
    check_end
    exit
fi
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

make_with_4 "$folder/libcylint-embree4.a" "$folder/libcylint.a" &&
    runs_example "$library" "$folder" -I"$folder/include" || {
    echo "FAILED $program"
    exit 1
}
# test_float_filter and test_embree_float_bounds do not use Embree.
make_with_4 left_out="$folder/tests/embree/test_float_filter $folder/tests/bounds/test_embree_float_bounds" \
    check-embree
