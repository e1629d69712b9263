"""A live face on sockets: the loop under asyncio, connections, their bounds, and who may come in."""
