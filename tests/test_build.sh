#!/bin/sh
# The Makefile: probes run after `deps`, what they find reaches the objects,
# nothing is compiled twice, and a test that could not run is named.
. "$(dirname "$0")/verdict.sh"
make=${MAKE:-make}
real=${CC:-cc}
unset MPFR GSL

# A machine whose packages lack MPFR until apt-get installs them: a compiler
# that finds no mpfr.h, and package tools that only note that they were called.
mkdir "$scratch/bin"
cat > "$scratch/bin/dpkg-query" << END
#!/bin/sh
[ -e "$scratch/installed" ] && echo 'install ok installed'
END
cat > "$scratch/bin/apt-get" << END
#!/bin/sh
case \$* in *install*) sleep 0.2; touch "$scratch/installed" ;; esac
END
cat > "$scratch/bin/sudo" << END
#!/bin/sh
exec "\$@"
END
cat > "$scratch/bin/bare-cc" << END
#!/bin/sh
case \$* in
*MPFR.c*) [ -e "$scratch/installed" ] || exit 1 ;;
*-E*) [ -e "$scratch/installed" ] || set -- -nostdinc "\$@" ;;
esac
exec $real "\$@"
END
chmod +x "$scratch"/bin/*
object=tests/test_ties.o

# make_bare ARGUMENT...: in $scratch/b, what it prints goes to $scratch/said
make_bare()
{
    PATH=$scratch/bin:$PATH $make -C "$top" BUILD="$scratch/b" \
        CC="$scratch/bin/bare-cc" CFLAGS="${flags:--O0}" "$@" \
        > "$scratch/said" 2>&1 || { cat "$scratch/said"; return 1; }
}

$make -C "$top" BUILD="$scratch/none" help | grep -q '^demo' &&
    [ ! -e "$scratch/none" ]
verdict help_builds_nothing $?

make_bare "$scratch/b/$object" && grep -q '^MPFR ?= *$' "$scratch/b/config.mk" &&
    ! grep -q HAVE_MPFR "$scratch/b/tests/flags"
verdict what_is_missing_is_not_used $?
make_bare "$scratch/b/$object" && ! grep -q '^CC ' "$scratch/said"
verdict nothing_is_compiled_twice $?
make_bare deps "$scratch/b/$object" &&
    grep -q '^MPFR ?= yes' "$scratch/b/config.mk" &&
    grep -q "^CC tests/test_ties.c" "$scratch/said"
verdict what_deps_installs_is_compiled_in_by_the_same_run $?
rm -rf "$scratch/b" "$scratch/installed"
make_bare -j4 deps "$scratch/b/$object" &&
    grep -q HAVE_MPFR "$scratch/b/tests/flags"
verdict and_so_it_is_by_parallel_jobs $?
make_bare "$scratch/b/$object" && ! grep -q '^CC ' "$scratch/said"
verdict and_not_compiled_again_by_the_next $?

flags=-O1
make_bare "$scratch/b/$object" && grep -qx 'CC tests/test_ties.c' "$scratch/said"
verdict other_flags_compile_again $?
flags=-O0
make_bare V=1 "$scratch/b/$object" && grep -q -e "-O0.*-c -o.*$object" "$scratch/said"
verdict V_1_prints_commands $?
! grep -i 'warning' "$scratch/said"
verdict make_warns_of_nothing $?

# systems that are not here
$make -n -C "$top" BUILD="$scratch/none" MACHINE=arm64-apple-darwin23 CC="$real" \
    PREFIX=/opt all > "$scratch/said" 2>&1 &&
    grep -q -e '-dynamiclib -install_name /opt/lib/libcylint\.0\.dylib' "$scratch/said" &&
    ! grep -q -e '-soname' "$scratch/said"
verdict macos_has_its_way_of_shared_libraries $?
$make -n -C "$top" BUILD="$scratch/none" MACHINE=x86_64-w64-mingw32 CC="$real" \
    all > "$scratch/said" 2>&1 &&
    grep -q -e '--out-implib,[^ ]*libcylint\.dll\.a' "$scratch/said"
verdict windows_has_its_way_of_shared_libraries $?

# a test that wants a package is named, and fails where CI=true
printf '#!/bin/sh\necho "no MPFR: no oracle (make deps)"\nexit 77\n' \
    > "$scratch/lacks.sh"
printf '#!/bin/sh\necho "no disk can be filled"\nexit 77\n' > "$scratch/other.sh"
MISSING=Embree CI='' sh tests/run.sh "$scratch/lacks.sh" "$scratch/other.sh" \
    > "$scratch/said" &&
    grep -q '^not tested: .*lacks.sh: no MPFR' "$scratch/said" &&
    grep -q '^not tested: what needs Embree' "$scratch/said" &&
    grep -q 'make deps' "$scratch/said" &&
    [ "$(tail -n 1 "$scratch/said")" = '0 passed, 0 failed, 2 skipped' ]
verdict what_was_not_tested_is_named_at_the_end $?
MISSING=Embree CI=true sh tests/run.sh "$scratch/lacks.sh" "$scratch/other.sh" \
    > "$scratch/said"
[ $? -ne 0 ] && [ "$(tail -n 1 "$scratch/said")" = '0 passed, 2 failed, 2 skipped' ]
verdict with_CI_it_fails $?
MISSING='' CI=true sh tests/run.sh "$scratch/other.sh" > "$scratch/said"
verdict with_CI_other_reasons_do_not_fail $?

check_end
