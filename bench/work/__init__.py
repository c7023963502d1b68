"""One file for each piece of work; each has ``measure``, which returns a section of the page."""
