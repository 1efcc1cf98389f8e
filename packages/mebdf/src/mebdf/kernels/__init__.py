"""The compiled core of the solver: functions of floats and arrays; no classes, no I/O."""
