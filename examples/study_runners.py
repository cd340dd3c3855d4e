"""Where the cases of a study run: in this process, in one for each core, in threads of the Python module, or on a Dask
cluster.

Each is a function of cases, materials and the number of workers, and yields rows, in any order, as they come.
"""

import contextlib
import multiprocessing
import signal
import tempfile
from concurrent import futures
from concurrent.futures.process import BrokenProcessPool
from multiprocessing import resource_tracker
from pathlib import Path

import study_worker

FOLDER = Path(study_worker.__file__).parent
PROGRAMS = [FOLDER / f"study_{part}.py" for part in ("worker", "fmus", "module")]
# A batch takes long enough that handing it out costs little, and is short enough to lose when a worker dies.
LARGEST_BATCH = 40
BATCHES_PER_WORKER = 20


def runner(scheduler, workers, with_module):
    """What runs the cases, and its number of workers."""
    if scheduler is None and with_module:
        return in_threads, workers
    if scheduler is None:
        return (serial if workers == 1 else pool), workers
    if scheduler == "local":
        return local_cluster, workers
    return lambda cases, materials, workers: cluster(cases, materials, workers, scheduler), workers


def batches(cases, workers):
    size = min(LARGEST_BATCH, max(1, len(cases) // (BATCHES_PER_WORKER * workers)))
    return [cases[start : start + size] for start in range(0, len(cases), size)]


def serial(cases, materials, workers):
    study_worker.prepare(materials)
    for batch in batches(cases, 1):
        yield study_worker.run_cases(batch)


def in_threads(cases, materials, workers):
    """In this process, in which the Python module has so many threads."""
    study_worker.prepare(materials)
    size = LARGEST_BATCH * workers
    for start in range(0, len(cases), size):
        yield study_worker.run_cases(cases[start : start + size], threads=workers)


@contextlib.contextmanager
def without_interrupts():
    """Processes that begin in here leave Ctrl-C to this one, which ends them; it comes here when this is over."""
    came = []
    handler = signal.signal(signal.SIGINT, lambda *_: came.append(True))
    blocks = hasattr(signal, "pthread_sigmask")
    if blocks:
        # Starting this one of multiprocessing's own would unblock what is blocked.
        resource_tracker.ensure_running()
        # For the processes, which inherit it; in this one another thread may take the signal, so there is a handler, too.
        before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        if blocks:
            signal.pthread_sigmask(signal.SIG_SETMASK, before)
        signal.signal(signal.SIGINT, handler)
    if came:
        raise KeyboardInterrupt


def pool(cases, materials, workers):
    """A process for each core."""
    if not cases:
        return
    context = multiprocessing.get_context("spawn")
    # Of this process: it is removed however the workers end.
    with tempfile.TemporaryDirectory(prefix="study") as folder:
        executor = futures.ProcessPoolExecutor(workers, context, study_worker.prepare, (materials, folder))
        try:
            with without_interrupts():
                submitted = [executor.submit(study_worker.run_cases, batch) for batch in batches(cases, workers)]
            for future in futures.as_completed(submitted):
                yield future.result()
        except BrokenProcessPool:
            raise SystemExit("a worker process died; the same command goes on from here") from None
        finally:
            executor.shutdown(wait=False, cancel_futures=True)
            for process in multiprocessing.active_children():
                process.terminate()
                process.join()


def local_cluster(cases, materials, workers):
    """A Dask cluster on this machine: what a real one does, at the size of this machine."""
    from distributed import Client, LocalCluster

    with contextlib.ExitStack() as held:
        with without_interrupts():
            local = held.enter_context(
                LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=":0", silence_logs="CRITICAL")
            )
            client = held.enter_context(Client(local))
        yield from through(client, cases, materials)


def cluster(cases, materials, workers, address):
    """A Dask cluster by its address. Its workers need FMPy or the Python module; the programs are sent to them."""
    from distributed import Client

    with Client(address) as client:
        for program in PROGRAMS:
            client.upload_file(str(program))
        yield from through(client, cases, materials)


def through(client, cases, materials):
    """The rows of all cases by way of a client of a cluster. The materials are sent once to each worker."""
    from distributed import as_completed

    [everything] = client.scatter([materials], broadcast=True, hash=False)
    threads = max(1, sum(client.nthreads().values()))
    # Not pure: the cluster shall not look whether it has run such a batch before.
    send = client.submit
    submitted = [send(study_worker.run_cases, batch, everything, pure=False) for batch in batches(cases, threads)]
    for future, rows in as_completed(submitted, with_results=True):
        yield rows
        future.release()
