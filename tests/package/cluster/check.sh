#!/bin/sh
# The recipes of cylint(7), MANY PROCESSORS, MANY MACHINES, give the bytes of one
# process.  If one record is bad they fail and write no complete answers.  Recipes
# without their tool are skipped; `make deps-cluster` installs the tools.  RECORDS
# is the number of records.
. "$(dirname "$0")/../../support/verdict.sh"
records=${RECORDS:-16000} pieces=8
PATH=$build:$build/spark/bin:$PATH
export PATH

result() # NAME STATUS
{
    if verdict "$1" "$2"; then
        echo "ok   $1"
    else
        grep -v ' INFO ' "$scratch/log" | tail -n 15
    fi
}

# Runs a command; sets $seconds and writes its output to the log.
timed()
{
    began=$(date +%s.%N)
    "$@" > "$scratch/log" 2>&1
    status=$?
    seconds=$(echo "$began $(date +%s.%N)" | awk '{ printf "%.1f", $2 - $1 }')
    return $status
}

# Writes a forest and numbered rays, in one file and in pieces.
make_input()
{
    mkdir "$scratch/rays" && awk -v trees=18 -f tools/demo/forest.awk > "$scratch/scene" &&
        awk -v height=1.6 -v azimuth=120 -v lowest=-13 -v highest=47 \
            -v columns=$((records / 80)) -v rows=80 -f tools/demo/scanner.awk |
        awk '{ print $0, "ray" NR }' > "$scratch/rays.txt" &&
        [ "$(wc -l < "$scratch/rays.txt")" -eq "$records" ] &&
        sh tests/support/recipe.sh save-scene > "$scratch/save" &&
        (cd "$scratch" && sh save) &&
        { [ -z "$python" ] || "$python" tests/package/cluster/table.py make \
            "$scratch/rays.txt" "$scratch/rays.parquet"; } &&
        split -n l/$pieces -d --additional-suffix=.txt "$scratch/rays.txt" "$scratch/rays/"
}

# Makes one record in the middle bad.
make_bad_input()
{
    sed -i "$((records / 2))s/^ray/rye/" "$scratch/rays.txt" &&
        { [ -z "$python" ] || "$python" tests/package/cluster/table.py make \
            "$scratch/rays.txt" "$scratch/rays.parquet"; } &&
        bad=$(grep -l '^' "$scratch"/rays/*.txt | sed -n "$((pieces / 2))p") &&
        sed -i '$s/^ray/rye/' "$bad"
}

clear_answers()
{
    rm -rf "$scratch/answers" "$scratch"/rays/*.answers
}

# Runs a recipe in the scratch folder, as the manual describes.
run_recipe()
{
    clear_answers
    sh tests/support/recipe.sh "$1" > "$scratch/recipe.py" # spark-submit needs this suffix
    (cd "$scratch" && case $1 in
        parallel-*) sh ./recipe.py ;;
        slurm) run_array ./recipe.py ;;
        spark-*) submit ./recipe.py ;;
    esac)
}

# Runs a script as sbatch runs an array: once for every task, with the options
# in its comments.
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

# Two executors in processes of their own, as on two machines.  They work and
# write messages in Spark's own folder, so this one consists of links.  Where musl
# is installed, Spark's snappy for Parquet fails to load; gzip is Java's own.
submit()
{
    rm -rf "$scratch/spark"
    mkdir "$scratch/spark"
    for part in "${SPARK_HOME:-$(find_spark_home.py)}"/*; do
        ln -s "$part" "$scratch/spark"
    done
    SPARK_HOME=$scratch/spark SPARK_LOCAL_IP=127.0.0.1 \
        spark-submit --master 'local-cluster[2,1,1024]' \
        --conf spark.ui.enabled=false --conf spark.task.maxFailures=1 \
        --conf spark.sql.parquet.compression.codec=gzip "$1"
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
    spark-arrow) "$python" tests/package/cluster/table.py show "$scratch/answers" ;;
    esac
}

expected_of()
{
    case $1 in
    spark-arrow) cylint -j1 -p 17 -f shape,t -s "$scratch/scene" "$scratch/rays.txt" ;;
    *) cat "$scratch/expected" ;;
    esac > "$scratch/expected_here"
}

succeeds()
{
    expected_of "$1" && timed run_recipe "$1" &&
        answers_of "$1" | cmp - "$scratch/expected_here"
    result "$1: $records records in the same bytes, $seconds s" $?
}

# A recipe fails with an exit status, a message and no complete answers.  The
# message is cylint's or, where parallel cut it off, parallel's.
fails()
{
    timed run_recipe "$1"
    [ $? -ne 0 ] &&
        grep -q -e "found 'rye'" -e 'This job failed' \
            -e 'the direction has no length' "$scratch/log" &&
        ! answers_of "$1" 2> /dev/null | cmp -s - "$scratch/expected" &&
        [ ! -e "$scratch/answers/_SUCCESS" ] && [ ! -f "$scratch/answers" ]
    result "$1: fails for one bad record, $seconds s" $?
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
    [ "$1" != spark-arrow ] || [ -n "$python" ] || {
        skip "$1" 'no Python package (make deps deps-cluster check)'
        return 1
    }
}

# The environment of Spark with the wheel that tests/python/test_python.sh has made.
python=$build/spark/bin/python
"$python" -m pip install -q --no-deps --no-index --force-reinstall \
    "$build"/python/wheel/*.whl 2> /dev/null &&
    "$python" -c 'import libcylint, pyarrow' 2> /dev/null || python=

recipes=
for recipe in parallel-pipe parallel-pipepart slurm spark-files spark-pipe spark-arrow; do
    have_tools_for $recipe && recipes="$recipes $recipe"
done
make_input || exit 1
timed cylint -j1 -s "$scratch/scene" -o "$scratch/expected" "$scratch/rays.txt"
result "one process: $records records, $seconds s" $?
for recipe in $recipes; do
    succeeds $recipe
done
make_bad_input || exit 1
for recipe in $recipes; do
    fails $recipe
done
check_end
