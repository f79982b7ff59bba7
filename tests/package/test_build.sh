#!/bin/sh
# The Makefile runs its probes after `deps`, objects depend on what the probes find,
# nothing is compiled twice, and tests that could not run are named.
. "$(dirname "$0")/../support/verdict.sh"
make=${MAKE:-make}
real=${CC:-cc}
unset MPFR MAKEFLAGS # -s and the like hide what is done

# A machine without MPFR until apt-get installs it: a compiler that finds no
# mpfr.h, and package tools that only record their calls.
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
echo 'exit 1 # no environment of Python is made' > "$scratch/bin/python3"
cat > "$scratch/bin/bare-cc" << END
#!/bin/sh
case \$* in
*MPFR.c*) [ -e "$scratch/installed" ] || exit 1 ;;
*-E*) [ -e "$scratch/installed" ] || set -- -nostdinc "\$@" ;;
esac
exec $real "\$@"
END
chmod +x "$scratch"/bin/*
object=tests/roots/test_midpoints.o

# make_bare ARGUMENT...: make in $scratch/b; its output goes to $scratch/output
make_bare()
{
    PATH=$scratch/bin:$PATH $make -C "$top" BUILD="$scratch/b" \
        CC="$scratch/bin/bare-cc" CFLAGS="${flags:--O0}" "$@" \
        > "$scratch/output" 2>&1 || { cat "$scratch/output"; return 1; }
}

$make -C "$top" BUILD="$scratch/none" help | grep -q '^demo' &&
    [ ! -e "$scratch/none" ]
verdict help_builds_nothing $?

make_bare "$scratch/b/$object" && grep -q '^MPFR ?= *$' "$scratch/b/config.mk" &&
    ! grep -q HAVE_MPFR "$scratch/b/tests/roots/flags"
verdict missing_packages_are_not_used $?
make_bare "$scratch/b/$object" && ! grep -q '^CC ' "$scratch/output"
verdict nothing_is_compiled_twice $?
make_bare deps "$scratch/b/$object" &&
    grep -q '^MPFR ?= yes' "$scratch/b/config.mk" &&
    grep -q "^CC tests/roots/test_midpoints.c" "$scratch/output"
verdict packages_from_deps_are_used_by_the_same_run $?
rm -rf "$scratch/b" "$scratch/installed"
make_bare -j4 deps "$scratch/b/$object" && grep -q HAVE_MPFR "$scratch/b/tests/roots/flags"
verdict packages_from_deps_are_used_by_parallel_jobs $?
make_bare "$scratch/b/$object" && ! grep -q '^CC ' "$scratch/output"
verdict the_next_run_compiles_nothing $?

flags=-O1
make_bare "$scratch/b/$object" && grep -qx 'CC tests/roots/test_midpoints.c' "$scratch/output"
verdict other_flags_compile_again $?
form=src/signs/forms.o vector=src/bvh/traverse.o
make_bare "$scratch/b/$form" "$scratch/b/$vector" &&
    make_bare small=-O1 "$scratch/b/$form" "$scratch/b/$vector" &&
    [ "$(grep '^CC ' "$scratch/output")" = "CC ${form%.o}.c" ]
verdict other_flags_of_small_code_compile_it_again $?
make_bare small=-O1 vectors=-O2 "$scratch/b/$form" "$scratch/b/$vector" &&
    [ "$(grep '^CC ' "$scratch/output")" = "CC ${vector%.o}.c" ]
verdict other_flags_of_vectors_compile_them_again $?
flags=-O0
make_bare V=1 "$scratch/b/$object" && grep -q -e "-O0.*-c -o.*$object" "$scratch/output"
verdict V_1_prints_commands $?
! grep -i 'warning' "$scratch/output"
verdict make_prints_no_warning $?

make_bare PTHREAD= "$scratch/b/tools/cylint/workers.o" && ! grep -i 'warning' "$scratch/output"
verdict without_threads_the_command_has_one_worker $?

# elsewhere ARGUMENT...: make in a folder outside of the sources
mkdir "$scratch/outside"
ln -s "$top" "$scratch/sources"
elsewhere()
{
    (cd "$scratch/outside" && $make -f ../sources/Makefile CC="$real" CFLAGS=-O0 "$@") \
        > "$scratch/output" 2>&1 || { cat "$scratch/output"; return 1; }
}

elsewhere build/$object && [ -s "$scratch/outside/build/$object" ]
verdict make_in_another_folder_builds_there $?
elsewhere BUILD=other other/$object && [ -s "$scratch/outside/other/$object" ]
verdict with_BUILD_it_builds_there $?
elsewhere -n DESTDIR=stage PREFIX=/usr install-folders &&
    grep -q "$scratch/outside/stage" "$scratch/output"
verdict with_DESTDIR_it_installs_there $?
$make -n -C "$top" BUILD="$scratch/b" PREFIX=inst install-folders | grep -q " $top/inst/bin "
verdict a_relative_PREFIX_becomes_a_whole_path $?
for variable in BUILD DESTDIR PREFIX; do
    for value in '/a b' "/a'b" '/a;b' '/a$$b' '~/b'; do
        ! $make -n -C "$top" "$variable=$value" install > "$scratch/output" 2>&1 &&
            grep -q "$variable begins with ~ or has a space or one of ' \"" "$scratch/output"
        verdict "${variable}_is_refused_if_it_is_$value" $?
    done
done
mkdir "$scratch/a b"
ln -s "$top"/* "$scratch/a b"
ln -s 'a b' "$scratch/blank"
! (cd "$scratch/outside" && $make -f "../a b/Makefile" help) > "$scratch/output" 2>&1 &&
    grep -q 'path of this Makefile has a space' "$scratch/output"
verdict make_in_another_folder_refuses_a_space_in_the_way_to_the_sources $?
(cd "$scratch/outside" && $make -f ../blank/Makefile help) | grep -q '^demo'
verdict it_reads_sources_in_a_folder_with_a_space $?
elsewhere clean help && [ ! -e "$scratch/outside/build" ] && grep -q '^demo' "$scratch/output"
verdict it_makes_several_goals $?

# other systems
$make -n -C "$top" BUILD="$scratch/none" MACHINE=arm64-apple-darwin23 CC="$real" \
    PREFIX=/opt all > "$scratch/output" 2>&1 &&
    grep -q -e '-dynamiclib -install_name /opt/lib/libcylint\.0\.dylib' "$scratch/output" &&
    ! grep -q -e '-soname' "$scratch/output"
verdict macos_links_shared_libraries_with_its_options $?
$make -n -C "$top" BUILD="$scratch/none" MACHINE=x86_64-w64-mingw32 CC="$real" \
    all > "$scratch/output" 2>&1 &&
    grep -q -e '--out-implib,[^ ]*libcylint\.dll\.a' "$scratch/output"
verdict windows_links_shared_libraries_with_its_options $?

make_bare WRAP= fuzz_programs > "$scratch/said"
[ $? -ne 0 ] && grep -q '^fuzz: .* does not link with its sanitizers' "$scratch/said" &&
    ! grep -q '^CC ' "$scratch/said"
verdict without_a_sanitizer_fuzz_says_so_and_compiles_nothing $?

# One object stands for the library's.
printf '#include <cylint.h>\nint main(void) { return !cylint_version(); }\n' > "$scratch/version.c"
if make_bare CFLAGS='-O0 -flto' libraries=libcylint library_objects="$scratch/lto/src/version.o" \
    commands= BUILD="$scratch/lto" DESTDIR="$scratch/lto" PREFIX=/usr install &&
    $real -flto -Iinclude -o "$scratch/version" "$scratch/version.c" "$scratch/lto/libcylint.a" \
        2> /dev/null; then
    $real -flto -Iinclude -o "$scratch/version" "$scratch/version.c" "$scratch/lto/usr/lib/libcylint.a" \
        2> "$scratch/output" && "$scratch/version" || { cat "$scratch/output"; false; }
    verdict with_flto_the_installed_library_links $?
fi

# version_library ARGUMENT...: links the library from the same object alone
version_library()
{
    make_bare BUILD="$scratch/links" libraries=libcylint commands= \
        library_objects="$scratch/links/src/version.o" "$@" all
}
version_library && version_library && ! grep '^LD' "$scratch/output"
verdict nothing_is_linked_twice $?
version_library LDFLAGS=-L. && grep -q '^LD .*libcylint' "$scratch/output"
verdict other_flags_of_the_linker_link_again $?
printf '#!/bin/sh\necho half > "$2"\nexit 1\n' > "$scratch/bin/half"
chmod +x "$scratch/bin/half"
! version_library clean all AR=half > "$scratch/said" && [ ! -e "$scratch/links/libcylint.a" ] &&
    grep -q "libcylint.a.* Error 1" "$scratch/output"
verdict a_step_that_fails_leaves_no_file_that_stands_for_done $?

# Code without wide vectors is slow after a function that leaves the upper halves
# of registers in use.  gcc does not clear them (vzeroupper) in a function with a
# vector among its arguments.
if command -v objdump > /dev/null && [ -n "$(ls "$build"/src/*/*-avx2.o 2> /dev/null)" ] &&
    grep -q -e ' -O[23] ' "$build/src/filter/flags"; then
    for object in "$build"/src/*/*-avx*.o "$build"/src/*/*-fma.o; do
        objdump -d --no-show-raw-insn "$object" | awk -v object="${object##*/}" '
            /^[0-9a-f]+ <.*>:$/ { f = $2; order[++n] = f }
            /%[yz]mm/ { wide[f]++ }
            /vzeroupper/ { clears[f]++ }
            END { for (i = 1; i <= n; i++) if (wide[order[i]] && !clears[order[i]]) print object, order[i] }'
    done > "$scratch/output"
    [ ! -s "$scratch/output" ] || { cat "$scratch/output"; false; }
    verdict functions_with_wide_vectors_clear_the_upper_halves $?
fi

# a test without its package is named, and fails with CI=true
printf '#!/bin/sh\necho "no MPFR: no oracle (make deps)"\nexit 77\n' > "$scratch/lacks.sh"
printf '#!/bin/sh\necho "no disk can be filled"\nexit 77\n' > "$scratch/other.sh"
# run_tests TEST...: in parallel; $scratch/output is what `make check` prints
run_tests()
{
    TESTS=$* BUILD=$scratch/results $make -s -j2 -f tests/support/run.mk \
        > "$scratch/output" 2> "$scratch/messages"
}

MISSING=Embree CI='' run_tests "$scratch/lacks.sh" "$scratch/other.sh" &&
    grep -q '^not tested: .*lacks.sh: no MPFR' "$scratch/output" &&
    grep -q '^not tested: what needs Embree' "$scratch/output" &&
    grep -q 'make deps' "$scratch/output" &&
    [ "$(tail -n 1 "$scratch/output")" = '0 passed, 0 failed, 2 skipped' ]
verdict skipped_tests_are_named_at_the_end $?
MISSING=Embree CI=true run_tests "$scratch/lacks.sh" "$scratch/other.sh"
[ $? -ne 0 ] && [ "$(tail -n 1 "$scratch/output")" = '0 passed, 2 failed, 2 skipped' ]
verdict with_CI_a_missing_package_fails $?
MISSING='' CI=true run_tests "$scratch/other.sh"
verdict with_CI_other_reasons_do_not_fail $?

# Of five tests one fails, two wait for each other, and two have no counts.
printf 'echo "what is wrong"\necho "4 passed, 1 failed"\nexit 1\n' > "$scratch/0.sh"
for i in 1 2; do
    cat > "$scratch/$i.sh" << END
touch "$scratch/met$i"
for second in 1 2 3 4 5 6 7 8 9; do
    [ ! -e "$scratch/met$((3 - i))" ] || { echo '$i passed, 0 failed'; exit; }
    sleep 1
done
echo '0 passed, 1 failed'
END
done
echo 'exit 3' > "$scratch/3.sh"
echo 'echo "0 passed, 0 failed"' > "$scratch/4.sh"
MISSING='' CI='' run_tests "$scratch/4.sh" "$scratch/3.sh" "$scratch/0.sh" "$scratch/2.sh" "$scratch/1.sh"
[ $? -ne 0 ] && sed "s|$scratch/||; s/([0-9.]* s)/(S s)/" "$scratch/output" > "$scratch/said" &&
    diff - "$scratch/said" << END
FAIL 0.sh (S s)
what is wrong
4 passed, 1 failed
ok   1.sh: 1 passed (S s)
ok   2.sh: 2 passed (S s)
FAIL 3.sh (S s)

(no counts; exit status 3)
FAIL 4.sh (S s)
0 passed, 0 failed
(no counts; exit status 0)
7 passed, 3 failed
END
verdict tests_run_side_by_side_and_a_failure_stops_none $?
check_end
