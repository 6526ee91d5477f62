"""The messages of the contract, written by generate.py. Private: they change with the contract."""
