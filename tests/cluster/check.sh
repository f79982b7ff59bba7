#!/bin/sh
# The recipes of cylint(7), MANY PROCESSORS, MANY MACHINES: each must give the
# bytes that one process gives, and must fail, without answers in the place of
# the whole ones, if one record is bad.  What has no tool here is skipped;
# `make deps-cluster` installs them.  RECORDS sets how many there are, RECIPES
# which are run.
LC_ALL=C
export LC_ALL
here=$(pwd)
build=${BUILD:-build}
case $build in /*) ;; *) build=$here/$build ;; esac
records=${RECORDS:-16000} pieces=8
PATH=$build:$build/spark/bin:$PATH
export PATH
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0 skipped=0

verdict() # status, text
{
    if [ "$1" -eq 0 ]; then
        passed=$((passed + 1))
        echo "ok   $2"
    else
        failed=$((failed + 1))
        echo "FAIL $2"
        tail -n 15 "$scratch/log"
    fi
}

skip() # recipe, why
{
    skipped=$((skipped + 1))
    echo "skip $1: $2"
}

# Seconds that a command took go to $seconds, what it says to the log.
timed()
{
    began=$(date +%s.%N)
    "$@" > "$scratch/log" 2>&1
    status=$?
    seconds=$(echo "$began $(date +%s.%N)" | awk '{ printf "%.1f", $2 - $1 }')
    return $status
}

# A forest, and a scan of it with every ray numbered, whole and in pieces.
make_input()
{
    mkdir "$scratch/rays" &&
        awk -v trees=18 -f tools/demo/forest.awk > "$scratch/scene" &&
        awk -v height=1.6 -v azimuth=120 -v lowest=-13 -v highest=47 \
            -v columns=$((records / 80)) -v rows=80 \
            -f tools/demo/scanner.awk |
        awk '{ print $0, "ray" NR }' > "$scratch/rays.txt" &&
        [ "$(wc -l < "$scratch/rays.txt")" -eq "$records" ] &&
        split -n l/$pieces -d --additional-suffix=.txt "$scratch/rays.txt" \
            "$scratch/rays/"
}

# The same with one bad record in the middle.
make_bad_input()
{
    sed -i "$((records / 2))s/^ray/rye/" "$scratch/rays.txt" &&
        bad=$(grep -l '^' "$scratch"/rays/*.txt | sed -n "$((pieces / 2))p") &&
        sed -i '$s/^ray/rye/' "$bad"
}

clear_answers()
{
    rm -rf "$scratch/answers" "$scratch"/rays/*.answers "$scratch"/rays/*.part
}

# In the scratch folder, as the manual says to run it.
run_recipe()
{
    clear_answers
    sh tests/recipe.sh "$1" > "$scratch/recipe.py" # what spark-submit wants
    (cd "$scratch" && case $1 in
        parallel-*) sh ./recipe.py ;;
        slurm) run_array ./recipe.py ;;
        spark-*) submit ./recipe.py ;;
    esac)
}

# What sbatch does with an array: the script once for every task, after the
# options in its comments.
run_array()
{
    bash -n "$1" &&
        [ "$(sed -n 's/^#SBATCH --array=1-//p' "$1")" -eq $pieces ] || return 1
    for task in $(seq $pieces); do
        SLURM_ARRAY_TASK_ID=$task \
            SLURM_CPUS_PER_TASK=$(sed -n 's/^#SBATCH --cpus-per-task=//p' "$1") \
            sh "$1" || failed_task=$task
    done
    [ -z "${failed_task:-}" ]
}

# Two executors, processes of their own, as on two machines.  They work, and
# leave their messages, in Spark's own folder: ours is made of links.
submit()
{
    rm -rf "$scratch/spark"
    mkdir "$scratch/spark"
    for part in "${SPARK_HOME:-$(find_spark_home.py)}"/*; do
        ln -s "$part" "$scratch/spark"
    done
    SPARK_HOME=$scratch/spark SPARK_LOCAL_IP=127.0.0.1 \
        spark-submit --master 'local-cluster[2,1,1024]' \
        --conf spark.ui.enabled=false --conf spark.task.maxFailures=1 "$1"
    status=$?
    cat "$scratch"/spark/work/*/*/stderr | grep '^cylint: '
    return $status
}

# All answers, in order.
answers_of()
{
    case $1 in
    parallel-*) cat "$scratch/answers" ;;
    slurm | spark-files) cat "$scratch"/rays/*.answers ;;
    spark-pipe) cat "$scratch"/answers/part-* ;;
    esac
}

succeeds()
{
    timed run_recipe "$1" && answers_of "$1" | cmp - "$scratch/expected"
    verdict $? "$1: $records records in the same bytes, $seconds s"
}

# Loudly: an exit status, a message, and no whole set of answers.  The message
# is the record's, or, where parallel cut that off, parallel's.
fails()
{
    timed run_recipe "$1"
    [ $? -ne 0 ] &&
        grep -q -e "found 'rye'" -e 'This job failed' "$scratch/log" &&
        ! answers_of "$1" 2> /dev/null | cmp -s - "$scratch/expected" &&
        [ ! -e "$scratch/answers/_SUCCESS" ] && [ ! -f "$scratch/answers" ]
    verdict $? "$1: fails for one bad record, $seconds s"
}

have_tools_for()
{
    case $1 in
    parallel-*) wanted=parallel ;;
    spark-*) wanted='java spark-submit' ;;
    slurm) wanted=bash ;;
    *) return 1 ;;
    esac
    for tool in $wanted; do
        command -v $tool > /dev/null || { skip "$1" "no $tool"; return 1; }
    done
}

all='parallel-pipe parallel-pipepart slurm spark-files spark-pipe'
recipes=
for recipe in ${RECIPES:-$all}; do
    have_tools_for $recipe && recipes="$recipes $recipe"
done
make_input || exit 1
timed cylint -j1 -s "$scratch/scene" -o "$scratch/expected" "$scratch/rays.txt"
verdict $? "one process: $records records, $seconds s"
for recipe in $recipes; do
    succeeds $recipe
done
make_bad_input || exit 1
for recipe in $recipes; do
    fails $recipe
done
printf '%d passed, %d failed, %d skipped\n' $passed $failed $skipped
[ $failed -eq 0 ]
