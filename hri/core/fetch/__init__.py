"""Getting large files from servers: archives, downloads and wheels of PyPI."""
