#!/bin/sh
# With compiler flags that break exact arithmetic the library does not compile, or,
# where no macro shows the flag, cylint_selftest() finds the fault.
. "$(dirname "$0")/../support/verdict.sh"
src=$top/src
cc=${CC:-cc}
flags="-std=c99 -O2 -I$top/include -I$src"

result() { # what status
    verdict "$1" "$2" || cat "$scratch/messages"
}

# supported FLAG...: whether the compiler supports the flags on this processor
supported() {
    $cc $flags "$@" -c -o "$scratch/probe.o" "$scratch/probe.c" 2>/dev/null && return
    printf 'note: %s does not support %s\n' "$cc" "$*"
    return 1
}

compiles() { # FLAG...
    $cc $flags "$@" -c -o "$scratch/x.o" "$src/roots/root.c" 2>"$scratch/messages"
}

accepted() { # FLAG...
    compiles "$@"
    result "accepted with $*" $?
}

# refused FLAG...: root.c does not compile, and the message is libcylint's
refused() {
    supported "$@" || return
    ! compiles "$@" && grep -q 'error.*libcylint' "$scratch/messages"
    result "refused with $* by a message of libcylint" $?
}

# found MASK FLAG...: the selftest of a program returns all bits of MASK; for
# MASK 0 it returns 0
found() {
    mask=$1
    shift
    supported "$@" || return
    $cc $flags "$@" -o "$scratch/selftest" "$scratch/main.c" "$src/selftest.c" \
        -lm 2>"$scratch/messages" || {
        printf 'note: %s does not link with %s\n' "$cc" "$*"
        return
    }
    "$scratch/selftest" >"$scratch/messages"
    got=$(cat "$scratch/messages")
    [ $((mask ? got & mask : got)) -eq "$mask" ]
    result "the selftest finds $mask with $*" $?
}

printf '#include <stdint.h>\nint probe(void) { return 0; }\n' >"$scratch/probe.c" # -m32 may lack headers
program() { # EXPRESSION: a program that prints its value
    printf '#include <cylint.h>\n#include <stdio.h>\nint main(void)\n'
    printf '{ return printf("%%d\\n", %s) < 0; }\n' "$1"
}
program 'cylint_selftest()' >"$scratch/main.c"
bit() { # NAME: the value of CYLINT_SELFTEST_NAME
    program "CYLINT_SELFTEST_$1" >"$scratch/bit.c"
    $cc $flags -o "$scratch/bit" "$scratch/bit.c" && "$scratch/bit"
}

accepted -ffp-contract=off
refused -ffast-math
refused -Ofast
refused -ffinite-math-only
refused -mfpmath=387
# where the C library's 32-bit headers are not installed, the others serve
mkdir "$scratch/gnu"
: >"$scratch/gnu/stubs-32.h"
refused -m32 -mfpmath=387 -idirafter "$scratch" \
    -idirafter "/usr/include/$($cc -print-multiarch 2>/dev/null)"

# A <float.h> of a machine with other doubles.
for wrong in 'FLT_EVAL_METHOD 2' 'FLT_EVAL_METHOD -1' 'DBL_MANT_DIG 64' \
             'DBL_MAX_EXP 128' 'FLT_RADIX 16'; do
    printf '#include_next <float.h>\n#undef %s\n#define %s\n' \
        "${wrong% *}" "$wrong" >"$scratch/float.h"
    refused "-I$scratch"
done
rm "$scratch/float.h"

found 0 -ffp-contract=off
found 0 -O0 -ffp-contract=off
found 0 -O3 -march=native -ffp-contract=off
# clang has no macro for this flag; as if gcc had none
found "$(bit UNROUNDED)" -ffp-contract=off -freciprocal-math -U__RECIPROCAL_MATH__
# clang's flag overrides the pragma of the source
fused=$(bit CONTRACTED)
grep -qw fma /proc/cpuinfo 2>/dev/null && found "$fused" -mfma -ffp-contract=fast
if $cc --version | grep -qi clang; then
    # the pragma of the source overrides the flag
    found 0 -mfma -ffp-contract=on
else
    # as if no macro showed these flags, as with older compilers
    found "$(bit UNROUNDED)" -ffp-contract=off -fno-signed-zeros -fno-trapping-math \
        -fassociative-math -U__ASSOCIATIVE_MATH__ -U__NO_SIGNED_ZEROS__
fi
# the start-up code that comes with -ffast-math flushes subnormals
case $($cc -dumpmachine) in x86_64-*)
    $cc $flags -ffp-contract=off -c -o "$scratch/own.o" "$src/selftest.c"
    if $cc -O2 -I"$top/include" -ffast-math -o "$scratch/fast" \
        "$scratch/main.c" "$scratch/own.o" -lm 2>"$scratch/messages"; then
        "$scratch/fast" >"$scratch/messages"
        [ "$(cat "$scratch/messages")" -eq $(($(bit FLUSHED) | $(bit ZEROED))) ]
        result 'the selftest finds flushing start-up code, and nothing else' $?
    fi ;;
esac

check_end
