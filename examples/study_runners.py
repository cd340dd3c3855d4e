"""Where the cases of a study run: in this process, on the cores of this machine, or on a Dask cluster.

Each is a function of cases, materials and the number of workers, and yields rows, in any order, as they come.
"""

import multiprocessing
from concurrent.futures import ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool

import study_worker

# A batch takes long enough that handing it out costs little, and is short enough to lose when a worker dies.
LARGEST_BATCH = 40
BATCHES_PER_WORKER = 20


def runner(scheduler, workers):
    """What runs the cases, and its number of workers."""
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


def pool(cases, materials, workers):
    """A process for each core."""
    if not cases:
        return
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(workers, context, study_worker.prepare, (materials,)) as executor:
        futures = [executor.submit(study_worker.run_cases, batch) for batch in batches(cases, workers)]
        try:
            for future in as_completed(futures):
                yield future.result()
        except BrokenProcessPool:
            raise SystemExit("a worker process died; the same command goes on from here") from None
        finally:
            executor.shutdown(wait=False, cancel_futures=True)


def local_cluster(cases, materials, workers):
    """A Dask cluster on this machine: what a real one does, at the size of this machine."""
    from distributed import LocalCluster

    with LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=None) as local:
        yield from cluster(cases, materials, workers, local)


def cluster(cases, materials, workers, where):
    """A Dask cluster by its address. Its workers need FMPy; this module's worker and the materials are sent to them."""
    from distributed import Client
    from distributed import as_completed as dask_as_completed

    with Client(where) as client:
        client.upload_file(study_worker.__file__)
        [everything] = client.scatter([materials], broadcast=True, hash=False)
        threads = max(1, sum(client.nthreads().values()))
        # Not pure: whether the cluster remembers a result of another study is not its business.
        futures = [
            client.submit(study_worker.run_cases, batch, everything, pure=False) for batch in batches(cases, threads)
        ]
        for future, rows in dask_as_completed(futures, with_results=True):
            yield rows
            future.release()
