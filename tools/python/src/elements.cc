/*
 * elements.cc - the elements of a call, and its work in threads
 */
#include "elements.h"

#include <exception>
#include <mutex>
#include <thread>

extern "C" {
#include "bvh/threads.h"
}

int Grid::add_none(size_t outer)
{
    bases.push_back(nullptr);
    while (axes.size() < outer)
        axes.push_back({1, {}});
    for (Axis &axis : axes)
        axis.strides.resize(bases.size(), 0);
    return static_cast<int>(bases.size()) - 1;
}

void Grid::finish(bool in_order)
{
    count = 1;
    for (const Axis &axis : axes)
        count *= axis.length;
    axes.erase(std::remove_if(axes.begin(), axes.end(),
                              [](const Axis &a) { return a.length == 1; }),
               axes.end());
    for (size_t a = axes.size(); a-- > 1;) {
        Axis &inner = axes[a - 1];
        const auto goes_on = [&inner](ptrdiff_t along, ptrdiff_t outer) {
            return outer == along * static_cast<ptrdiff_t>(inner.length);
        };
        if (std::equal(inner.strides.begin(), inner.strides.end(),
                       axes[a].strides.begin(), goes_on)) {
            inner.length *= axes[a].length;
            axes.erase(axes.begin() + static_cast<ptrdiff_t>(a));
        }
    }
    if (axes.empty())
        axes.push_back({1, std::vector<ptrdiff_t>(bases.size(), 0)});
    if (!in_order)
        std::swap(axes[0], *std::max_element(axes.begin(), axes.end(),
                                             [](const Axis &a, const Axis &b) {
                                                 return a.length < b.length;
                                             }));
}

void Grid::locate(size_t row, size_t i, std::vector<char *> &at) const
{
    at = bases;
    for (size_t axis = 0; axis < axes.size(); axis++) {
        const size_t to = axis == 0 ? i : row % axes[axis].length;
        for (size_t a = 0; a < at.size(); a++)
            at[a] += static_cast<ptrdiff_t>(to) * axes[axis].strides[a];
        if (axis > 0)
            row /= axes[axis].length;
    }
}

/* ------------------------------------------------------------- threads -- */

namespace
{

/* How often the calling thread takes the lock. */
constexpr auto interval = std::chrono::milliseconds(50);

/* Starting a thread takes about the time of this many small blocks. */
constexpr size_t blocks_a_thread = 4;

std::atomic<int> unlocked_calls{0};
unsigned long exiting_thread = 0; /* 0: Python does not exit */

/* The caller has Python's lock. */
void stop_at_exit()
{
    if (exiting_thread == 0 || exiting_thread == PyThread_get_thread_ident())
        return;
    PyErr_SetNone(PyExc_SystemExit);
    throw nb::python_error();
}

PyThreadState *unlock()
{
    stop_at_exit();
    unlocked_calls++;
    return PyEval_SaveThread();
}

} // namespace

Unlocked::Unlocked() : state(unlock())
{
}

Unlocked::~Unlocked()
{
    PyEval_RestoreThread(state);
    unlocked_calls--;
}

void end_calls()
{
    exiting_thread = PyThread_get_thread_ident();
    while (unlocked_calls > 0) {
        if (PyErr_CheckSignals() != 0)
            throw nb::python_error();
        const nb::gil_scoped_release released;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

void forget_calls()
{
    unlocked_calls = 0;
}

Listener::Listener(const Callback &callback, size_t elements)
    : progress(callback), total(elements), due(Clock::now() + interval)
{
}

void Listener::listen(double part)
{
    if (Clock::now() < due)
        return;
    {
        nb::gil_scoped_acquire acquired;
        stop_at_exit();
        if (PyErr_CheckSignals() != 0)
            throw nb::python_error();
        if (progress)
            (*progress)(static_cast<size_t>(part * static_cast<double>(total)),
                        total);
    }
    due = Clock::now() + interval;
}

void Listener::end() const
{
    if (!progress)
        return;
    nb::gil_scoped_acquire acquired;
    (*progress)(total, total);
}

int workers_for(size_t blocks, int threads)
{
    return cylint_threads_for(blocks + blocks_a_thread, blocks_a_thread,
                              threads);
}

void work(size_t blocks, size_t total, int workers, const Callback &progress,
          const std::function<bool(int, size_t)> &task)
{
    Listener listener(progress, total);
    const auto caller = std::this_thread::get_id();
    std::atomic<size_t> next{0}, done{0};
    std::atomic<bool> stopped{false};
    std::mutex lock;
    std::exception_ptr failure;
    std::function<void(int)> loop = [&](int worker) {
        const bool listens = std::this_thread::get_id() == caller;
        try {
            for (size_t i; !stopped && (i = next++) < blocks; done++) {
                if (!task(worker, i))
                    stopped = true;
                if (listens)
                    listener.listen(static_cast<double>(done) /
                                    static_cast<double>(blocks));
            }
        } catch (...) {
            const std::lock_guard<std::mutex> hold(lock);
            if (!failure)
                failure = std::current_exception();
            stopped = true;
        }
    };
    const Unlocked unlocked;
    const auto run = [](void *function, size_t worker, size_t) {
        (*static_cast<decltype(loop) *>(function))(static_cast<int>(worker));
    };
    cylint_threads_share(workers, static_cast<size_t>(workers), 1, 1, run,
                         &loop);
    if (failure)
        std::rethrow_exception(failure);
    if (!stopped)
        listener.end();
}
