"""A race of hybridrt against other renderers: same scenes, cameras, lights, size and threads. Started by scripts/peers.py."""
