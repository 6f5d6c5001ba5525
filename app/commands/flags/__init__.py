"""Command-line flags that several subcommands share."""
