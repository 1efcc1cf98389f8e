"""The live workbench: a page on this machine whose controls run a case, and whose pictures follow.

A server answers one user. Every run is done by a worker process, which returns the bytes of a
frame; the server adds nothing to them but the number of the request.
"""
