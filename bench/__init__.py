"""elbowroom beside its peers: the same work in one run, everybody's answers checked (``make bench``)."""
