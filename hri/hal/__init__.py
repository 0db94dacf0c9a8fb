"""Resources: pieces of hardware, or their stand-ins, behind one small interface each."""
