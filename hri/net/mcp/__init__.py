"""An assistant's door to the robot, by the Model Context Protocol (MCP), docs/assistants.md.

permission, arguments, tools   its requests, and their arguments
state, recent_events, names    the view of the robot that it gets, without names of people
authored, proposals            the files it may read, and the drafts that it proposes
checking, check                mistakes in such a file, found by a child process
calls                          how a call is admitted, limited, marked, and carried out
protocol                       all of it as a server of the official SDK
stdio, http, connections       how messages come
bearer, rate                   who may come over HTTP, and how much is taken
session                        the jobs of a robot that has such a door
"""
