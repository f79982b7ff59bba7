#!/bin/sh
# install_folders.sh make|remove DESTDIR RECORD FOLDER...
#
# make: makes the folders and adds those that did not exist to the file RECORD.
# remove: removes the folders, those of RECORD, and RECORD; a folder that is not
# empty stays.  RECORD and FOLDER are paths below DESTDIR, which may be empty.
action=$1 root=$2 record=$3
shift 3
umask 022

# missing FOLDER: the folder and those above it that do not exist, top first
missing()
{
    [ -d "$root$1" ] || {
        missing "$(dirname "$1")"
        printf '%s\n' "$1"
    }
}

case $action in
make)
    [ -d "$root/" ] || install -d "$root" || exit
    made=$(for folder; do missing "$folder"; done | sort -u)
    for folder; do
        [ -d "$root$folder" ] || install -d "$root$folder" || exit
    done
    [ -z "$made" ] || printf '%s\n' "$made" >> "$root$record"
    ;;
remove)
    # In the reverse order a folder follows those in it.
    all=$({ printf '%s\n' "$@"; cat "$root$record" 2> /dev/null; } | sort -r -u)
    rm -f "$root$record"
    printf '%s\n' "$all" | while IFS= read -r folder; do
        rmdir "$root$folder" 2> /dev/null
    done
    exit 0
    ;;
esac
