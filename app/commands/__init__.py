"""The subcommands of `tofscope`, a module each."""
