/*
 * work.h - a call's work in blocks, by several threads, without Python's lock
 */
#ifndef CYLINT_PYTHON_WORK_H
#define CYLINT_PYTHON_WORK_H

#include <nanobind/nanobind.h>

#include <cstddef>
#include <functional>

/*
 * Calls task(worker, block) for all blocks, in their order, from at most
 * `threads` threads; worker is below `threads`.  Python's lock is released.  The
 * calling thread works too.  Several times a second it takes the lock, lets
 * Python handle signals, and calls progress(done, total), unless progress is
 * None; done counts elements, of which a block has total / blocks on average.
 * The last such call has done = total.  An exception of Python or of a task
 * ends the work and is passed on.  A task that returns false ends it, too.
 */
void work(size_t blocks, size_t total, int threads, nanobind::handle progress,
          const std::function<bool(int worker, size_t block)> &task);

#endif
