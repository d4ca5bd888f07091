# Tests that are scripts rather than Catch2 cases; each has a label, `fast` or `slow`.
