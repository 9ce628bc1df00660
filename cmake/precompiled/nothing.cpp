// Headers alone make no target.
