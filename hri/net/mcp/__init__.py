"""An assistant's door to the robot, by the Model Context Protocol (MCP), docs/assistants.md.

permission, arguments, tools   what it may ask, and with what
state, recent_events, names    what it is shown of the robot, and whose names it is not
authored, proposals            the files it may read, and the drafts that it proposes
checking, check                what is wrong with such a file, found by a child process
calls                          how a call is admitted, limited, marked, and carried out
protocol                       all of it as a server of the official SDK, which only this imports
stdio, http, connections       how messages come
bearer                         who may come over HTTP
session                        the jobs of a robot that has such a door
"""
