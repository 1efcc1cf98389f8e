from scipy import linalg
from threadpoolctl import threadpool_info, threadpool_limits

from tribodyn.core.linear_algebra import one_thread


def threads() -> set[int]:
    assert linalg.svdvals([[1.0]]) == [1.0]
    return {library["num_threads"] for library in threadpool_info() if library["user_api"] == "blas"}


def test_one_thread_within_the_block_and_as_many_as_before_after_it() -> None:
    with threadpool_limits(2, user_api="blas"):
        before = threads()
        with one_thread():
            assert threads() == {1}
        assert threads() == before
