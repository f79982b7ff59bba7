#!/bin/sh
# install_hints.sh BINDIR LIBDIR MANDIR: prints the lines that make the shell,
# the compiler, the loader and man(1) find what was installed there, where they
# do not find it already.  They can be pasted into a shell or a profile.
bin=$1 lib=$2 man=$3

# among DIRECTORY LIST: is it in a list separated by colons?
among()
{
    case :$2: in *:$1:*) ;; *) false ;; esac
}

hint()
{
    [ -n "$hints" ] || echo 'To use what was installed, set:'
    hints=yes
    printf '    %s\n' "$1"
}

# man(1) mostly looks beside the directories in PATH as well.
is_manual_found()
{
    among "$man" "$MANPATH" ||
        among "$man" "$(PATH=$bin:$PATH manpath -q 2>/dev/null)"
}

is_package_found()
{
    among "$lib/pkgconfig" "$PKG_CONFIG_PATH" ||
        among "$lib/pkgconfig" \
            "$(pkg-config --variable pc_path pkg-config 2>/dev/null)"
}

PATH=$PATH:/sbin:/usr/sbin
loader=LD_LIBRARY_PATH
[ "$(uname)" != Darwin ] || loader=DYLD_LIBRARY_PATH
eval "libraries=\${$loader:-}"

hints=
among "$bin" "$PATH" || hint "export PATH=$bin:\$PATH"
is_manual_found || hint "export MANPATH=$man:\$MANPATH"
is_package_found ||
    hint "export PKG_CONFIG_PATH=$lib/pkgconfig:\$PKG_CONFIG_PATH"
if ! among "$lib" "$libraries" &&
    ! ldconfig -p 2>/dev/null | grep -q "=> $lib/libcylint\.so"; then
    if ldconfig -N -v 2>/dev/null | grep -q "^$lib:"; then
        hint 'ldconfig    # as root'
    else
        hint "export $loader=$lib\${$loader:+:\$$loader}"
    fi
fi
exit 0
