/*
 * merge_sort_template.h - sorts an array, stable, in time n log n
 *
 * Included once for each type.  Before, the file defines
 *
 *   SORTED            the type of the elements
 *   IS_BEFORE(x, y)   whether the element *x must stand before *y
 *   SORT              the name of the function
 */
#define RUN 8 /* elements that are sorted by insertion */

static void SORT(SORTED *from, size_t n, SORTED *spare)
{
    SORTED *to = spare;
    for (size_t first = 0; first < n; first += RUN) {
        const size_t end = n - first < RUN ? n : first + RUN;
        for (size_t i = first + 1; i < end; i++) {
            const SORTED x = from[i];
            size_t j = i;
            for (; j > first && IS_BEFORE(&x, &from[j - 1]); j--)
                from[j] = from[j - 1];
            from[j] = x;
        }
    }
    for (size_t width = RUN; width < n; width *= 2) {
        for (size_t first = 0; first < n; first += 2 * width) {
            const size_t middle = n - first < width ? n : first + width;
            const size_t end = n - middle < width ? n : middle + width;
            size_t i = first, j = middle;
            for (size_t k = first; k < end; k++)
                to[k] =
                    j == end || (i < middle && !IS_BEFORE(&from[j], &from[i]))
                        ? from[i++]
                        : from[j++];
        }
        SORTED *swap = from;
        from = to;
        to = swap;
    }
    if (from == spare && n > 0)
        memcpy(to, from, n * sizeof *to);
}

#undef RUN
#undef SORTED
#undef IS_BEFORE
#undef SORT
