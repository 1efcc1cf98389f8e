"""Phases of the machine between two calls, and its requests to the caller."""

from typing import Final

NEED_F: Final = 1
NEED_JACOBIAN: Final = 2
STEP_ACCEPTED: Final = 3
FAILED: Final = 4
NEED_FACTORS: Final = 5
NEED_SOLUTION: Final = 6
NEED_MAGNITUDE: Final = 7

STEP_TOO_SMALL: Final = 1
NOT_FINITE: Final = 2
JACOBIAN_NOT_FINITE: Final = 3
NO_PROGRESS: Final = 4

ERROR_TEST: Final = 1
NEWTON: Final = 2
SINGULAR: Final = 3

BEGIN: Final = 0
FIRST_F: Final = 1
SECOND_F: Final = 2
STEP: Final = 3
FACTORISE: Final = 4
START_STAGE: Final = 5
ITERATE: Final = 6
ACCEPT: Final = 7
AFTER: Final = 8
FACTORISED: Final = 9
CORRECT: Final = 10
CONCLUDE: Final = 11
LINEARISED: Final = 12
