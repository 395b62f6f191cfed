"""What a World is made of: a file for each subject."""
