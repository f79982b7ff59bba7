#!/bin/sh
# The command's answers, byte by byte, from every compiler, optimisation and
# processor that can be had here: relation, n, t, part and side must be the
# same everywhere; for what is derived from t, columns that differ are listed.
# Input: hard.txt, and CYLINT_CASES (100000) records of all families with
# CYLINT_SEED (1).  Called by `make check-cross`; takes some minutes.
here=$(dirname "$0")
build=${BUILD:-build}/cross
records=${BUILD:-build}/tests/records
mkdir -p "$build" || exit 1
passed=0 failed=0 skipped=0

exact=relation,n,t0,t1,part0,part1,side0,side1
derived=x0,y0,z0,nx0,ny0,nz0,h0,phi0,x1,y1,z1,nx1,ny1,nz1,h1,phi1,chord

# gcc -m32 without gcc-multilib, which Debian does not install beside cross
# compilers, looks for the kernel's headers nowhere.
kernel_headers="-idirafter /usr/include/$(gcc -print-multiarch 2>/dev/null)"

# name | compiler | its flags | flags to link | what runs the program
builds() {
    cat <<END
gcc -O2|gcc|-O2||
gcc -O0|gcc|-O0||
gcc -O3|gcc|-O3||
gcc -O3 -march=native|gcc|-O3 -march=native||
clang -O0|clang|-O0||
clang -O3|clang|-O3||
clang -O3 -mfma|clang|-O3 -mfma||
gcc -m32 (SSE2)|gcc|-O2 -m32 -msse2 -mfpmath=sse $kernel_headers|-m32|
aarch64 (qemu)|aarch64-linux-gnu-gcc|-O2|-static|qemu-aarch64
s390x, big-endian (qemu)|s390x-linux-gnu-gcc|-O2|-static|qemu-s390x
END
}

skip() { # name reason
    skipped=$((skipped + 1))
    printf 'skip %s: %s\n' "$1" "$2"
}

# usable COMPILER FLAGS LINK RUNNER: whether programs can be built and run;
# says what is missing
usable() {
    for tool in "$1" $4; do
        command -v "$tool" >/dev/null || { echo "no $tool"; return 1; }
    done
    printf '#include <errno.h>\n#include <math.h>\nint main(int n, char **x)\n%s\n' \
        '{ return x[0] && sqrt((double)n) != 1; }' >"$build/probe.c"
    $1 $2 $3 -o "$build/probe" "$build/probe.c" -lm 2>/dev/null ||
        { echo "$1 $2 does not link"; return 1; }
    $4 "$build/probe" 2>/dev/null || { echo 'its programs do not run'; return 1; }
}

# answers FOLDER COLUMNS RUNNER: asks, into FOLDER/answers
answers() {
    $3 "$1/cylint" -x -f "$2" "$build/input" >"$1/answers" 2>"$1/messages"
    status=$?
    [ $status -eq 0 ] || {
        printf 'exit status %d\n' $status
        head -n 3 "$1/messages"
    }
}

# columns_that_differ FOLDER: against the first build's derived columns
columns_that_differ() {
    paste "$build/derived" "$1/answers" | awk -F '\t' -v names="$derived" '
    BEGIN { n = split(names, name, ",") }
    {
        for (i = 1; i <= n; i++) if ($i != $(n + i)) {
            if (!off[i]++) first[i] = NR
        }
    }
    END {
        for (i = 1; i <= n; i++) if (off[i]) {
            printf "     %s differs in %d of %d, first in record %d\n",
                   name[i], off[i], NR, first[i]
            any = 1
        }
        if (!any) print "     derived columns are the same bytes too"
    }'
}

if [ ! -x "$records" ]; then
    echo "$records has not been built"
    exit 77
fi
grep '=>' "$here/hard.txt" | grep -v '^#' | sed 's/ *=>.*//' >"$build/input"
"$records" "${CYLINT_SEED:-1}" "${CYLINT_CASES:-100000}" >>"$build/input" ||
    exit
printf '%d records\n' "$(wc -l <"$build/input")"

builds >"$build/table"
reference=
while IFS='|' read -r name compiler flags link runner; do
    missing=$(usable "$compiler" "$flags" "$link" "$runner") || {
        skip "$name" "$missing"
        continue
    }
    folder=$build/$(printf '%s' "$name" | tr -c 'a-zA-Z0-9\n' _)
    # numbers by the C library, since few targets have a C++ one
    if ! ${MAKE:-make} -s -j 2 -C "$here/.." CC="$compiler" CXX17= MPFR= GSL= \
        CFLAGS="$flags" LDFLAGS="$link" BUILD="$(cd "$build" && pwd)/${folder##*/}" \
        "$(cd "$build" && pwd)/${folder##*/}/cylint" \
        >"$build/messages" 2>&1; then
        printf 'FAIL %s: it cannot be built\n' "$name"
        tail -n 5 "$build/messages"
        failed=$((failed + 1))
        continue
    fi
    trouble=$(answers "$folder" "$exact" "$runner" </dev/null)
    if [ -z "$reference" ]; then
        reference=$name
        cp "$folder/answers" "$build/exact"
    fi
    if [ -z "$trouble" ] && cmp -s "$build/exact" "$folder/answers"; then
        passed=$((passed + 1))
        printf 'ok   %s\n' "$name"
    else
        failed=$((failed + 1))
        printf 'FAIL %s: %s\n' "$name" "$trouble"
        printf '%d answers differ\n' \
            "$(diff "$build/exact" "$folder/answers" | grep -c '^>')"
        paste "$build/input" "$build/exact" "$folder/answers" |
            awk -F '\t' '{
                want = got = ""
                for (i = 2; i <= 9; i++) want = want " " $i
                for (i = 10; i <= NF; i++) got = got " " $i
            }
            want != got && n++ < 5 {
                printf "%s\n  got %s\n  want%s\n", $1, got, want
            }'
    fi
    trouble=$(answers "$folder" "$derived" "$runner" </dev/null)
    if [ "$reference" = "$name" ]; then
        cp "$folder/answers" "$build/derived"
    else
        columns_that_differ "$folder"
    fi
done <"$build/table"

printf 'answers of %s are the measure\n' "$reference"
[ "$skipped" -eq 0 ] && printf '%d passed, %d failed\n' $passed $failed ||
    printf '%d passed, %d failed, %d skipped\n' $passed $failed $skipped
[ "$failed" -eq 0 ] && [ "$passed" -gt 1 ]
