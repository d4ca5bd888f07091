# One OBJECT library per instruction set, all from the same sources.
