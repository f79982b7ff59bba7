#!/bin/sh
# The reasons that stand beside lines of the sources (tests/support/reasons.py) concern
# mutants and branches that these lines have; what the headers and the manuals promise
# has its tests (tests/promises.txt); comments and pages name what exists.
. "$(dirname "$0")/../support/verdict.sh"
command -v python3 > /dev/null || skip_all 'no python3'
PYTHONDONTWRITEBYTECODE=1
export PYTHONDONTWRITEBYTECODE

python3 tests/support/promises.py
verdict every_promise_stands_in_its_document_and_has_tests $?

python3 tests/support/references.py
verdict comments_and_pages_name_what_exists $?

python3 tests/support/mutants.py --check
verdict every_reason_concerns_its_line $?

# A reason that is right, one for a mutant that the line does not have, and one
# for a branch that the line does not have.
mkdir -p "$scratch/tests/support" "$scratch/src"
cp tests/support/mutants.py tests/support/reasons.py "$scratch/tests/support"
cat > "$scratch/src/x.c" << 'END'
int f(int x)
{
    /* mutant '+' -> '-', '1' -> '2': nobody
     * uses it */
    x = x + 1;
    x = x + 3; /* mutant '2' -> '3': nobody uses it */
    /* untaken 1 of 2: nobody calls it */
    return x;
}
END
! python3 "$scratch/tests/support/mutants.py" --check > "$scratch/found" &&
    [ "$(cat "$scratch/found")" = "src/x.c:6: no mutant '2' -> '3'
src/x.c:8: no branch" ]
verdict a_stale_reason_is_found $? || cat "$scratch/found"
check_end
