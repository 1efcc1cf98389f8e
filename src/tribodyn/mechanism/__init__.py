"""Any mechanism: bodies, joints ideal or with clearance, springs, drives and loads, given as data."""
