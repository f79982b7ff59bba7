# The running error of pairs: what is lost is counted over the roundings that the
# sum of it meets in doubles, 5 an operation and 8 of what one loses and of its use.
# modes: ne
# bound: CYLINT_SLACK
{ d1 in [0, 1] -> d1 / (SHRINK(CYLINT_DEPTH) * SHRINK(CYLINT_DEPTH)
                        * SHRINK(CYLINT_DEPTH) * SHRINK(CYLINT_DEPTH)
                        * SHRINK(CYLINT_DEPTH) * SHRINK(8)) <= BOUND }
