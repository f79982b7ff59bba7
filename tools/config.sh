#!/bin/sh
# config.sh FILE - writes what this machine has into FILE, as make variables
#
# The Makefile includes FILE.  The compilers and their flags are in the
# environment: CC CXX CPPFLAGS CFLAGS CXXFLAGS LDFLAGS EMBREE_CFLAGS
# EMBREE_LIBS.  Each probe compiles and links a small program.  The first
# lines of FILE are what the probes depend on: the compilers, their flags and
# the headers that exist.  If these are as before, FILE is left alone and
# nothing is probed.
file=$1
mkdir -p "$(dirname "$file")" || exit 1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
: "${CC:=cc}" "${CXX:=c++}"

# facts: one preprocessor run that prints the compiler's version and the
# optional headers that it finds
facts() {
    printf '%s\n' "$CC" "$CXX" "$CPPFLAGS" "$CFLAGS" "$CXXFLAGS" "$LDFLAGS" \
        "$EMBREE_CFLAGS" "$EMBREE_LIBS"
    command -v $CXX >/dev/null && echo 'a C++ compiler'
    {
        echo '__VERSION__'
        echo '#ifdef __has_include'
        for header in mpfr.h gmp.h png.h pthread.h poll.h \
            embree3/rtcore.h embree4/rtcore.h; do
            printf '#if __has_include(<%s>)\n"%s"\n#endif\n' $header $header
        done
        echo '#endif'
    } >"$work/facts.c"
    $CC $CPPFLAGS $EMBREE_CFLAGS $CFLAGS -E "$work/facts.c" 2>/dev/null |
        grep -v -e '^#' -e '^$'
    cksum <"$0"
}

facts | sed 's/^/# /' >"$work/facts"
[ -e "$file" ] && head -n "$(wc -l <"$work/facts")" "$file" |
    cmp -s - "$work/facts" && exit

# probe NAME VALUE COMMAND...: assigns VALUE to NAME if COMMAND succeeds, else
# nothing.  `?=` leaves a variable alone that the user has set.  Probes run
# side by side; $work/NAME.out is theirs.
probe() {
    name=$1 value=$2
    shift 2
    {
        "$@" -o "$work/$name.out" >/dev/null 2>&1 || value=
        printf '%s ?= %s\n' "$name" "$value" >"$work/$name.mk"
    } &
}

# probe_header NAME HEADER FLAG...: assigns yes if a C program that includes HEADER
# links with the flags
probe_header() {
    name=$1 header=$2
    shift 2
    printf '#include <stdio.h>\n#include <%s>\nint main(void)\n{ return 0; }\n' \
        "$header" >"$work/$name.c"
    probe "$name" yes $CC $CPPFLAGS $CFLAGS $LDFLAGS "$work/$name.c" "$@"
}

probe_header MPFR mpfr.h -lmpfr -lgmp
probe_header PNG png.h -lpng
probe_header PTHREAD pthread.h -pthread
probe_header POSIX poll.h -pthread -include pthread.h
probe_header WRAP stdio.h -Wl,--wrap=read
probe_header EMBREE_3 embree3/rtcore.h $EMBREE_CFLAGS ${EMBREE_LIBS:--lembree3}
probe_header EMBREE_4 embree4/rtcore.h $EMBREE_CFLAGS ${EMBREE_LIBS:--lembree4}

# what the command's C++ part needs, linked to an object of the C compiler's
echo 'int c_part;' >"$work/c_part.c"
$CC $CPPFLAGS $CFLAGS -c -o "$work/c_part.o" "$work/c_part.c" 2>/dev/null
printf '#include <charconv>\nint main()\n%s\n' \
    '{ char c; double x = 1; return std::to_chars(&c, &c, x).ptr == std::from_chars(&c, &c, x).ptr; }' \
    >"$work/charconv.cc"
probe CXX17 yes $CXX -std=c++17 $CPPFLAGS $CXXFLAGS $LDFLAGS \
    "$work/charconv.cc" "$work/c_part.o"

# an x86 processor, and a compiler that supports its instruction sets; to include
# immintrin.h would take longer than all other probes
cat >"$work/x86.c" <<'END'
#if !__has_include(<immintrin.h>) || !defined __x86_64__ && !defined __i386__
#error
#endif
int main(void)
{
    return !__builtin_cpu_supports("avx512dq");
}
END
probe X86 yes $CC $CPPFLAGS $CFLAGS $LDFLAGS -mavx512f -mavx512dq \
    "$work/x86.c"
wait

{
    cat "$work/facts"
    printf 'MACHINE ?= %s\n' "$($CC -dumpmachine 2>/dev/null)"
    grep -q yes "$work/EMBREE_3.mk" && embree=3 || embree=
    grep -q yes "$work/EMBREE_4.mk" && embree=4
    printf 'EMBREE ?= %s\n' "$embree"
    printf 'EMBREE_LIBS ?= %s\n' "${embree:+-lembree$embree}"
    rm "$work"/EMBREE_*.mk
    cat "$work"/*.mk
} >"$file.new" && mv "$file.new" "$file"
