"""The values of --profile; completion_test.py compares them with the command's."""

PROFILES = ("fastest", "jerk", "trapezoidal", "quintic", "s-curve")
