"""What was made last."""

from concurrent.futures import ThreadPoolExecutor

from tribodyn.core.remembered import Remembered


def test_what_is_remembered_is_made_once_and_bounded() -> None:
    known: Remembered[int] = Remembered(32)
    assert [known.made(k, k.__int__) for k in range(40)] == list(range(40))
    assert known.made(39, lambda: -1) == 39
    assert known.made(0, lambda: -1) == -1
    assert len(known) == 32


def test_threads_that_ask_for_many_things_get_their_own() -> None:
    known: Remembered[int] = Remembered(4)

    def ask(k: int) -> bool:
        return known.made(k % 50, lambda: k % 50) == k % 50

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(ask, range(20_000)))
    assert len(known) <= 4
